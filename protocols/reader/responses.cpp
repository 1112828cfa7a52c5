#include "protocols/reader/responses.h"

#include "base/csv.h"
#include "base/files.h"
#include "protocols/reader/cell_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace obscura {

namespace {

using R = Response;

constexpr bool any(const R&) { return true; }

// Shorthand for the checks below: a named string, number or set.
template <auto field>
bool filled(const R& r) {
    return !(r.*field).empty();
}
template <auto field>
bool positive(const R& r) {
    return r.*field >= 1;
}
template <auto field>
bool notNegative(const R& r) {
    return r.*field >= 0;
}
// Milliseconds of a session, whose clock starts with it: eleven days are no session.
template <auto field>
bool duration(const R& r) {
    return r.*field >= 0 && r.*field <= 1e9; // false for NaN
}
template <auto field>
bool digest(const R& r) {
    const std::string& text = r.*field;
    return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool isUtcTime(std::string_view given) {
    constexpr std::string_view shape = "dddd-dd-ddTdd:dd:ddZ";
    return std::equal(given.begin(), given.end(), shape.begin(), shape.end(),
                      [](char c, char s) { return s == 'd' ? c >= '0' && c <= '9' : c == s; });
}

constexpr std::string_view anyText = "text", some = "text, not empty", flag = "0 or 1",
                           count = "a whole number >= 1", milliseconds = "a number from 0 to 1e9",
                           whole = "a whole number >= 0", hash = "64 hexadecimal digits";

const Column columns[] = {
    {"schema_version", "Version of this list of columns", &R::schemaVersion,
     "the version whose columns the header names", any},
    {"row_id", "Unique name of the row: participant, session, trial", &R::rowId, some,
     filled<&R::rowId>},
    {"study_id", "Name of the study, from the protocol", &R::studyId, some, filled<&R::studyId>},
    {"participant_id", "Pseudonym of the participant", &R::participantId, some,
     filled<&R::participantId>},
    {"session_id", "Session of this participant", &R::sessionId, some, filled<&R::sessionId>},
    {"simulated", "1 when a program answered, not a person", &R::simulated, flag, any},
    {"slot_id", "Place in the ordering scheme, claimed from the ledger, from 1", &R::slotId, count,
     positive<&R::slotId>},
    {"square_id", "Latin square that the slot belongs to, from 1", &R::squareId, count,
     positive<&R::squareId>},
    {"square_row", "Row of that square, from 1", &R::squareRow, count, positive<&R::squareRow>},
    {"pairs_reversed", "1 when this slot exchanges the two images of every pair", &R::pairsReversed,
     flag, any},
    {"trial_index", "Position of the trial in the session, from 1", &R::trialIndex, count,
     positive<&R::trialIndex>},
    {"trial_kind", "practice, main or catch", &R::trialKind, "practice, main or catch",
     [](const R& r) {
         return r.trialKind == "practice" || r.trialKind == "main" || r.trialKind == "catch";
     }},
    {"repeat_index", "Which presentation of this condition to this participant, from 1",
     &R::repeatIndex, count, positive<&R::repeatIndex>},
    {"condition_id", "Condition, from the protocol", &R::conditionId, some,
     filled<&R::conditionId>},
    {"level", "Complexity level of the lighting", &R::level, some, filled<&R::level>},
    {"scene", "Scene and camera, from the protocol", &R::scene, some, filled<&R::scene>},
    {"hypothesis", "Hypothesis that the condition tests", &R::hypothesis, anyText, any},
    {"technique_a", "Technique of member a", &R::techniqueA, some, filled<&R::techniqueA>},
    {"technique_b", "Technique of member b", &R::techniqueB, some, filled<&R::techniqueB>},
    {"params_a", "Settings of member a, JSON", &R::paramsA, anyText, any},
    {"params_b", "Settings of member b, JSON", &R::paramsB, anyText, any},
    {"stim_first", "File shown first", &R::stimFirst, some, filled<&R::stimFirst>},
    {"stim_second", "File shown second", &R::stimSecond, some, filled<&R::stimSecond>},
    {"sha256_first", "SHA-256 of that file", &R::sha256First, hash, digest<&R::sha256First>},
    {"sha256_second", "SHA-256 of that file", &R::sha256Second, hash, digest<&R::sha256Second>},
    {"first_is", "Member shown first", &R::firstIs, "a or b",
     [](const R& r) { return r.firstIs == "a" || r.firstIs == "b"; }},
    {"onset1_ms", "Onset of image 1 on the session's clock, ms", &R::onset1Ms, milliseconds,
     duration<&R::onset1Ms>},
    {"view1_ms", "Time image 1 was on view, ms", &R::view1Ms, milliseconds, duration<&R::view1Ms>},
    {"mask_frames_planned", "Display refreshes the grey mask should last", &R::maskFramesPlanned,
     count, positive<&R::maskFramesPlanned>},
    {"mask_frames_shown", "Display refreshes it lasted", &R::maskFramesShown, whole,
     notNegative<&R::maskFramesShown>},
    {"mask_ms", "Time the mask was on view, ms", &R::maskMs, milliseconds, duration<&R::maskMs>},
    {"onset2_ms", "Onset of image 2 on the session's clock, ms", &R::onset2Ms, milliseconds,
     duration<&R::onset2Ms>},
    {"view2_ms", "Time image 2 was on view, ms", &R::view2Ms, milliseconds, duration<&R::view2Ms>},
    {"question_onset_ms", "Onset of the question on the session's clock, ms", &R::questionOnsetMs,
     milliseconds, duration<&R::questionOnsetMs>},
    {"decision_rt_ms", "Time from question to answer, ms", &R::decisionRtMs, milliseconds,
     duration<&R::decisionRtMs>},
    {"refresh_hz",
     "Refresh rate measured at the start; the pacing clock's where there is no "
     "vertical blank",
     &R::refreshHz, "a number from 1 to 10000",
     [](const R& r) { return r.refreshHz >= 1 && r.refreshHz <= 10000; }},
    {"missed_frames", "Frame intervals above 1.2 refreshes during the mask", &R::missedFrames,
     whole, notNegative<&R::missedFrames>},
    {"timestamp_source",
     "How onsets were timed: oml (vertical blank counter), finish (swap, then "
     "wait for the GPU), none (no vertical blank: paced by the clock)",
     &R::timestampSource, "oml, finish, fence or none",
     [](const R& r) {
         return r.timestampSource == "oml" || r.timestampSource == "finish" ||
                r.timestampSource == "fence" || r.timestampSource == "none";
     }},
    {"chosen_position", "Image chosen: 1 or 2", &R::chosenPosition, "1 or 2",
     [](const R& r) { return r.chosenPosition == 1 || r.chosenPosition == 2; }},
    {"chosen_technique", "Technique of the chosen image", &R::chosenTechnique,
     "technique_b's value when chose_b is 1, else technique_a's",
     [](const R& r) { return r.chosenTechnique == (r.choseB ? r.techniqueB : r.techniqueA); }, 1,
     true},
    {"chose_b", "1 when member b was chosen", &R::choseB,
     "1 when chosen_position and first_is say so, else 0",
     [](const R& r) { return r.choseB == ((r.chosenPosition == 2) == (r.firstIs == "a")); }, 1,
     true},
    {"interrupted",
     "1 when the window lost the keyboard, or Escape was pressed, while an image or the mask was "
     "on view",
     &R::interrupted, flag, any},
    {"early_presses_in_mask", "Keys pressed during the mask, and discarded", &R::earlyPressesInMask,
     whole, notNegative<&R::earlyPressesInMask>},
    {"app_version", "Version of Obscura", &R::appVersion, some, filled<&R::appVersion>},
    {"git_commit", "Commit that Obscura was built from", &R::gitCommit, some,
     filled<&R::gitCommit>},
    {"protocol_sha256", "SHA-256 of the protocol file", &R::protocolSha256, hash,
     digest<&R::protocolSha256>},
    {"machine_id", "Name of the machine", &R::machineId, some, filled<&R::machineId>},
    {"wall_time_utc", "When the row was written, ISO 8601, UTC", &R::wallTimeUtc,
     "a time such as 2026-01-31T23:59:59Z", [](const R& r) { return isUtcTime(r.wallTimeUtc); }},
    {"rehearsal", "1 when the session was a rehearsal, which does not count", &R::rehearsal, flag,
     any, 2},
    {"design_sha256",
     "SHA-256 of the study's design: conditions, order, trial and images, without texts",
     &R::designSha256, hash, digest<&R::designSha256>, 2},
};

std::string spell(const Response& response, const Column& column) {
    struct {
        const Response& row;
        std::string operator()(std::string R::*field) const { return csvCell(row.*field); }
        std::string operator()(int R::*field) const { return fmt::format("{}", row.*field); }
        std::string operator()(bool R::*field) const { return row.*field ? "1" : "0"; }
        std::string operator()(double R::*field) const { return fmt::format("{:.3f}", row.*field); }
    } speller{response};
    return std::visit(speller, column.field);
}

bool parseCell(Response& response, const Column& column, const std::string& cell) {
    struct {
        Response& row;
        const std::string& cell;
        bool operator()(std::string R::*field) const {
            row.*field = cell;
            return true;
        }
        bool operator()(int R::*field) const { return readCell(cell, row.*field); }
        bool operator()(double R::*field) const { return readCell(cell, row.*field); }
        bool operator()(bool R::*field) const {
            row.*field = cell == "1";
            return cell == "0" || cell == "1";
        }
    } parser{response, cell};
    return std::visit(parser, column.field);
}

std::vector<std::string> namesOf(std::span<const Column> list) {
    std::vector<std::string> names;
    for (const Column& column : list)
        names.emplace_back(column.name);
    return names;
}

// The earliest version that has every column of the header.
int versionOf(const CsvRecord& header) {
    int version = 1;
    for (const Column& column : columns)
        if (std::count(header.cells.begin(), header.cells.end(), column.name))
            version = std::max(version, column.since);
    return version;
}

// Columns whose texts tell people, conditions and pictures apart.
bool isName(const Column& column) {
    constexpr std::string_view names[] = {
        "row_id", "study_id",   "participant_id", "session_id",  "condition_id",    "level",
        "scene",  "hypothesis", "technique_a",    "technique_b", "chosen_technique"};
    return std::find(std::begin(names), std::end(names), column.name) != std::end(names);
}

std::string textFault(const Column& column, const std::string& cell) {
    const std::string fault = foreignByte(cell);
    return fault.empty() && isName(column) ? strayName(cell) : fault;
}

// Parses rows, each in the memory of the one before. Most cells of a row are those of the row above
// it; what has been checked once is not checked again.
class RowParser {
  public:
    RowParser(CsvRecord header, int version, std::string file)
        : header_(std::move(header)), list_(responseColumns(version)), version_(version),
          file_(std::move(file)), isAsAbove_(list_.size()) {
        checkHeader(header_, namesOf(list_), file_);
    }

    // Takes the record's cells.
    std::optional<BadRow> parse(CsvRecord& record) {
        std::optional<BadRow> bad = faultIn(record);
        known_ = !bad;
        above_.swap(record.cells);
        return bad;
    }
    const Response& response() const { return response_; }

  private:
    std::optional<BadRow> faultIn(const CsvRecord& record) {
        // A whole row needs no line feed: editors leave it out. What is torn lacks cells or fails
        // below.
        if (!record.fault.empty() || record.cells.size() != list_.size())
            return BadRow{{file_, record.line, 0, {}}, faultOf(record, list_.size())};
        if (record.cells == header_.cells)
            return BadRow{{file_, record.line, 0, {}},
                          "the header stands here again, as where two files were joined; remove "
                          "the line"};
        for (std::size_t i = 0; i < list_.size(); ++i)
            isAsAbove_[i] = known_ && record.cells[i] == above_[i];
        for (std::size_t i = 0; i < list_.size(); ++i)
            if (!isAsAbove_[i])
                if (const std::string fault = textFault(list_[i], record.cells[i]); !fault.empty())
                    return BadRow{place(record, i), fault};
        for (const bool check : {false, true}) // every cell first: a check may read several
            for (std::size_t i = 0; i < list_.size(); ++i)
                if (!(check ? passes(i) : reads(record, i)))
                    return BadRow{place(record, i),
                                  fmt::format("expected {}, found \"{}\"{}", list_[i].expected,
                                              record.cells[i], cellHint(record.cells[i]))};
        if (response_.schemaVersion != version_)
            return BadRow{place(record, 0),
                          fmt::format("expected {}, whose columns the header names, found {}",
                                      version_, response_.schemaVersion)};
        return std::nullopt;
    }

    Place place(const CsvRecord& record, std::size_t column) const {
        return {file_, record.line, static_cast<int>(column) + 1, std::string(list_[column].name)};
    }
    bool reads(const CsvRecord& record, std::size_t column) {
        return isAsAbove_[column] || parseCell(response_, list_[column], record.cells[column]);
    }
    bool passes(std::size_t column) const {
        return (isAsAbove_[column] && !list_[column].readsOthers) ||
               list_[column].accepts(response_);
    }

    CsvRecord header_;
    std::vector<Column> list_; // of the file's version
    int version_;
    std::string file_;
    Response response_;
    std::vector<std::string> above_; // cells of the row above, if
    bool known_ = false;             // it was well
    std::vector<char> isAsAbove_;    // of each cell of this row
};

} // namespace

std::span<const Column> responseColumns() { return columns; }

std::vector<Column> responseColumns(int version) {
    std::vector<Column> result;
    std::copy_if(std::begin(columns), std::end(columns), std::back_inserter(result),
                 [&](const Column& column) { return column.since <= version; });
    return result;
}

std::string responseHeader() {
    std::string line;
    for (const Column& column : columns)
        line += fmt::format("{}{}", line.empty() ? "" : ",", column.name);
    return line + "\n";
}

std::string responseLine(const Response& response) {
    std::string line;
    for (const Column& column : columns)
        line.append(line.empty() ? "" : ",").append(spell(response, column));
    return line + "\n";
}

ResponseRows eachResponse(const std::filesystem::path& path, bool lenient,
                          const std::function<void(const Response&, int line)>& take,
                          const FilePart& part) {
    const std::string file = path.string();
    ResponseRows result;
    const auto reject = [&](const Place& place, const std::string& message) {
        if (!lenient)
            throw Error(place, message + "; --lenient skips it");
        result.bad.push_back({place, message});
    };
    CsvReader reader(path);
    CsvRecord record;
    bool found = reader.next(record);
    while (found && isBlank(record))
        found = reader.next(record);
    if (!found || !record.ended) {
        reject({file, 0, 0, {}}, "expected a header line; the file ends before that line does");
        return result;
    }
    result.version = versionOf(record);
    if (std::count(record.cells.begin(), record.cells.end(), "votes_a"))
        throw Error({file, record.line, 0, "votes_a"},
                    "expected the rows of participants, found a table of counted votes; give it as "
                    "--counts FILE");
    RowParser parser(record, result.version, file);
    if (part.begin > 0) {
        reader.goTo(part.begin);
        result.read.begin = reader.offset();
    }
    while (reader.offset() < part.end && reader.next(record)) {
        if (isBlank(record))
            continue;
        const int line = record.line;
        if (const auto bad = parser.parse(record))
            reject(bad->place, bad->message);
        else
            take(parser.response(), line);
    }
    result.read.end = reader.offset();
    result.lines = reader.line() - 1;
    return result;
}

ResponseFile readResponses(const std::filesystem::path& path, bool lenient) {
    ResponseFile file;
    static_cast<ResponseRows&>(file) =
        eachResponse(path, lenient, [&](const Response& response, int line) {
            file.rows.push_back(response);
            file.lines.push_back(line);
        });
    return file;
}

} // namespace obscura
