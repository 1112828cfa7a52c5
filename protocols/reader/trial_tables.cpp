#include "protocols/reader/trial_tables.h"

#include "base/csv.h"
#include "base/files.h"
#include "protocols/reader/cell_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <optional>
#include <span>
#include <type_traits>

namespace obscura {

namespace {

template <typename Row, typename Kind>
concept Is = std::same_as<std::remove_const_t<Row>, Kind>;

// Every field with its column's name and meaning, once for header, line, reader and description.

template <typename Key, typename Visit>
void eachOfKey(Key& key, Visit& visit) {
    visit("schema_version", "Version of this list of columns", key.schemaVersion);
    visit("row_id", "Unique name of the line: participant, session, trial, phase or question",
          key.rowId);
    visit("study_id", "Name of the study, from the protocol", key.studyId);
    visit("participant_id", "Pseudonym of the participant", key.participantId);
    visit("session_id", "Session of this participant", key.sessionId);
    visit("simulated", "1 when a program answered, not a person", key.simulated);
    visit("rehearsal", "1 when the session was a rehearsal, which does not count", key.rehearsal);
    visit("slot_id", "Place in the ordering scheme, claimed from the ledger, from 1", key.slotId);
    visit("trial_index",
          "Position of the trial in the session, from 1; 0 for pages around the trials",
          key.trialIndex);
    visit("trial_kind", "practice, main or catch; before or after for pages around the trials",
          key.trialKind);
    visit("repeat_index", "Which presentation of this condition to this participant, from 1",
          key.repeatIndex);
    visit("block", "Block of the session, from 1", key.block);
    visit("condition_id", "Condition, from the protocol", key.conditionId);
    visit("level", "Complexity level of the lighting", key.level);
    visit("scene", "Scene and camera, from the protocol", key.scene);
    visit("hypothesis", "Hypothesis that the condition tests", key.hypothesis);
    visit("roles", "Which role was at which place of the trial, such as b>a", key.roles);
    visit("techniques", "The techniques of these roles, in the same order", key.techniques);
}

template <Is<PhaseRow> Row, typename Visit>
void eachField(Row& row, Visit visit) {
    eachOfKey(row.trial, visit);
    visit("phase_index", "Position of the phase in the trial, from 1", row.phaseIndex);
    visit("phase", "Name of the phase", row.phase);
    visit("images", "Roles of the images on view, + between", row.images);
    visit("files", "Their files, + between", row.files);
    visit("sha256", "SHA-256 of these files, + between", row.sha256);
    visit("onset_ms", "Onset on the session's clock, ms", row.onsetMs);
    visit("view_ms", "Time on view, ms", row.viewMs);
    visit("frames_planned", "Display refreshes that a phase of fixed length should last; else 0",
          row.framesPlanned);
    visit("frames_shown", "Display refreshes that such a phase lasted; else 0", row.framesShown);
    visit("missed_frames", "Frame intervals above 1.2 refreshes during such a phase",
          row.missedFrames);
    visit("early_presses", "Keys pressed while none counted, and dropped", row.earlyPresses);
    visit("hasty_presses", "Keys pressed before the phase might end, and dropped",
          row.hastyPresses);
    visit("interrupted", "1 when the window lost the keyboard, or Escape was pressed, meanwhile",
          row.interrupted);
    visit("timed_out", "1 when the phase ended without an answer", row.timedOut);
    visit("refresh_hz",
          "Refresh rate measured at the start; the pacing clock's where there is no vertical blank",
          row.refreshHz);
    visit("timestamp_source", "How onsets were timed: oml, finish, fence or none",
          row.timestampSource);
}

template <Is<AnswerRow> Row, typename Visit>
void eachField(Row& row, Visit visit) {
    eachOfKey(row.trial, visit);
    visit("phase", "Name of the phase in which the question was asked", row.phase);
    visit("question", "Name of the question, unique in its trial", row.question);
    visit("kind", "Kind of question: choice, scale, slider, rank, number or text", row.kind);
    visit("value",
          "The answer: number of the option from 1, or unsure; number of a scale or slider; places "
          "of ranked images, best first; else what was typed",
          row.value);
    visit("role", "Role of the image that the answer means, or of those ranked, best first",
          row.role);
    visit("response_ms", "Time from the onset of the question's page to the answer, ms",
          row.responseMs);
    visit("interrupted", "1 when the trial was interrupted while something to look at was on view",
          row.interrupted);
    visit("app_version", "Version of Obscura", row.appVersion);
    visit("git_commit", "Commit that Obscura was built from", row.gitCommit);
    visit("protocol_sha256", "SHA-256 of the protocol file", row.protocolSha256);
    visit("design_sha256",
          "SHA-256 of the study's design: conditions, order, trial and images, without texts",
          row.designSha256);
    visit("machine_id", "Name of the machine", row.machineId);
    visit("wall_time_utc", "When the line was written, ISO 8601, UTC", row.wallTimeUtc);
}

std::string spelt(const std::string& text) { return csvCell(text); }
std::string spelt(int number) { return fmt::format("{}", number); }
std::string spelt(double number) { return fmt::format("{:.3f}", number); }
std::string spelt(bool flag) { return flag ? "1" : "0"; }

template <typename Row>
std::string headerOf() {
    std::vector<std::string> names;
    Row row;
    eachField(row, [&](const char* name, const char*, const auto&) { names.emplace_back(name); });
    return fmt::format("{}\n", fmt::join(names, ","));
}

template <typename Row>
std::string lineOf(const Row& row) {
    std::vector<std::string> cells;
    eachField(row,
              [&](const char*, const char*, const auto& value) { cells.push_back(spelt(value)); });
    return fmt::format("{}\n", fmt::join(cells, ","));
}

std::string expectedOf(const std::string&) { return "text"; }
std::string expectedOf(int) { return "a whole number >= 0"; }
std::string expectedOf(double) { return "a number from 0 to 1e9"; }
std::string expectedOf(bool) { return "0 or 1"; }

template <typename Row>
std::vector<TableColumn> columnsOf() {
    std::vector<TableColumn> columns;
    Row row;
    eachField(row, [&](const char* name, const char* description, const auto& value) {
        columns.push_back({name, description, expectedOf(value)});
    });
    return columns;
}

bool parse(std::string& text, const std::string& cell) {
    text = cell;
    return true;
}
bool parse(int& number, const std::string& cell) { return readCell(cell, number) && number >= 0; }
bool parse(double& number, const std::string& cell) {
    return readCell(cell, number) && number >= 0 && number <= 1e9; // false for NaN
}
bool parse(bool& flag, const std::string& cell) {
    flag = cell == "1";
    return cell == "0" || cell == "1";
}

// Columns whose texts tell lines, people, conditions and questions apart; all but the last three
// are never empty.
bool isName(std::string_view column) {
    constexpr std::string_view names[] = {"row_id",       "study_id", "participant_id",
                                          "session_id",   "phase",    "question",
                                          "condition_id", "roles",    "techniques"};
    return std::find(std::begin(names), std::end(names), column) != std::end(names);
}

std::string faultOf(std::string_view column, const std::string& cell) {
    if (const std::string fault = foreignByte(cell); !fault.empty() || !isName(column))
        return fault;
    if (cell.empty() && column != "condition_id" && column != "roles" && column != "techniques")
        return "expected text, found nothing";
    return strayName(cell);
}

template <typename Row>
std::vector<std::string> namesOf() {
    std::vector<std::string> names;
    for (const TableColumn& column : columnsOf<Row>())
        names.push_back(column.name);
    return names;
}

// Why the record is no row; nothing when it is, which then is in `row`.
template <typename Row>
std::optional<BadRow> parseRow(const CsvRecord& record, const std::string& file, Row& row) {
    std::optional<BadRow> bad;
    std::size_t at = 0;
    eachField(row, [&](const char* name, const char*, auto& value) {
        const std::string& cell = record.cells[at++];
        if (bad)
            return;
        std::string fault = faultOf(name, cell);
        if (fault.empty() && !parse(value, cell))
            fault =
                fmt::format("expected {}, found \"{}\"{}", expectedOf(value), cell, cellHint(cell));
        if (!fault.empty())
            bad = BadRow{{file, record.line, static_cast<int>(at), name}, fault};
    });
    // Pages before and after the trials belong to no condition.
    const bool ofTrial = row.trial.trialKind != "before" && row.trial.trialKind != "after";
    if (!bad && ofTrial && row.trial.conditionId.empty()) {
        const auto names = namesOf<Row>();
        const auto column = std::find(names.begin(), names.end(), "condition_id") - names.begin();
        bad = BadRow{{file, record.line, static_cast<int>(column) + 1, "condition_id"},
                     "expected text, found nothing"};
    }
    if (!bad && row.trial.schemaVersion != TrialKey().schemaVersion)
        bad = BadRow{{file, record.line, 1, "schema_version"},
                     fmt::format("expected {}, found {}: written by another version of this "
                                 "program; read it with that",
                                 TrialKey().schemaVersion, row.trial.schemaVersion)};
    return bad;
}

template <typename Row>
TrialTable<Row> parse(const std::string& content, const std::string& file, bool lenient) {
    checkIsCsv(content, file);
    std::vector<CsvRecord> records = splitCsv(content);
    std::erase_if(records, isBlank);
    const std::vector<std::string> names = namesOf<Row>();
    TrialTable<Row> table;
    const auto reject = [&](const BadRow& bad) {
        if (!lenient)
            throw Error(bad.place, bad.message + "; --lenient skips it");
        table.bad.push_back(bad);
    };
    if (records.empty() || !records.front().ended) {
        reject({{file, 0, 0, {}}, "expected a header line; the file ends before that line does"});
        return table;
    }
    checkHeader(records.front(), names, file);
    for (const CsvRecord& record : std::span(records).subspan(1)) {
        Row row;
        std::optional<BadRow> bad;
        if (!record.fault.empty() || record.cells.size() != names.size())
            bad = BadRow{{file, record.line, 0, {}}, obscura::faultOf(record, names.size())};
        else
            bad = parseRow(record, file, row);
        if (bad) {
            reject(*bad);
            continue;
        }
        table.rows.push_back(std::move(row));
        table.lines.push_back(record.line);
    }
    return table;
}

} // namespace

std::vector<TableColumn> phaseColumns() { return columnsOf<PhaseRow>(); }
std::vector<TableColumn> answerColumns() { return columnsOf<AnswerRow>(); }
std::string phaseHeader() { return headerOf<PhaseRow>(); }
std::string phaseLine(const PhaseRow& row) { return lineOf(row); }
std::string answerHeader() { return headerOf<AnswerRow>(); }
std::string answerLine(const AnswerRow& row) { return lineOf(row); }

TrialTable<PhaseRow> readPhases(const std::filesystem::path& path, bool lenient) {
    return parse<PhaseRow>(readFile(path), path.string(), lenient);
}

TrialTable<AnswerRow> readAnswers(const std::filesystem::path& path, bool lenient) {
    return parse<AnswerRow>(readFile(path), path.string(), lenient);
}

std::vector<PhaseRow> phaseRowsOf(const std::string& lines, const std::string& file) {
    return parse<PhaseRow>(phaseHeader() + lines, file, false).rows;
}

std::vector<AnswerRow> answerRowsOf(const std::string& lines, const std::string& file) {
    return parse<AnswerRow>(answerHeader() + lines, file, false).rows;
}

} // namespace obscura
