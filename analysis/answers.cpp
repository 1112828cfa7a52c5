#include "analysis/answers.h"

#include "base/files.h"
#include "protocols/reader/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>

namespace obscura {

namespace fs = std::filesystem;

namespace {

bool isDataFile(const fs::directory_entry& entry) {
    const fs::path& path = entry.path();
    return entry.is_regular_file() && path.extension() == ".csv" &&
           !path.filename().string().starts_with('.'); // a file still being written
}

std::vector<fs::path> filesOf(const fs::path& given) {
    if (!fs::exists(given))
        throw Error({given.string(), 0, 0, {}}, "expected a study's folder or a CSV file, found "
                                                "nothing of this name");
    if (!fs::is_directory(given))
        return {given};
    const fs::path folder = fs::is_directory(given / "data") ? given / "data" : given;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (isDataFile(entry))
            files.push_back(entry.path());
    if (files.empty())
        throw Error({folder.string(), 0, 0, {}},
                    fs::exists(given / "sessions" / "design.json")
                        ? "expected rows of pairs, found none: the trials of this study are no "
                          "pairs, and this program reads only those so far. Its answers are in "
                          "sessions/*_answers.csv"
                        : "expected CSV files of responses, found none");
    std::sort(files.begin(), files.end());
    return files;
}

// Each file once, even if it is given by name and again by its folder.
std::vector<fs::path> filesOf(std::span<const fs::path> data) {
    std::vector<fs::path> files, known;
    for (const fs::path& given : data)
        for (const fs::path& file : filesOf(given)) {
            const fs::path canonical = fs::canonical(file);
            if (std::find(known.begin(), known.end(), canonical) != known.end())
                continue;
            known.push_back(canonical);
            files.push_back(file);
        }
    return files;
}

std::string at(const Answer& answer) {
    return fmt::format("{}:{}", answer.place.file, answer.place.line);
}

[[noreturn]] void refuse(const Answer& answer, std::string_view column, const std::string& why) {
    Place place = answer.place;
    place.key = column;
    throw Error(place, why);
}

void removeSimulated(std::vector<Answer>& answers, SimulatedRows rule, LeftOut& leftOut) {
    const auto isSimulated = [](const Answer& answer) { return answer.row.simulated; };
    const auto real = std::find_if_not(answers.begin(), answers.end(), isSimulated);
    const auto simulated = std::find_if(answers.begin(), answers.end(), isSimulated);
    if (rule == SimulatedRows::refuse && real != answers.end() && simulated != answers.end())
        refuse(*simulated, "simulated",
               fmt::format("a simulated row among real ones ({}); --simulated exclude leaves such "
                           "rows out, only counts nothing else, include pools them",
                           at(*real)));
    if (rule == SimulatedRows::exclude)
        leftOut.simulated = static_cast<int>(std::erase_if(answers, isSimulated));
    if (rule == SimulatedRows::only)
        leftOut.real = static_cast<int>(std::erase_if(answers, std::not_fn(isSimulated)));
}

void removeRehearsals(Answers& answers) {
    answers.leftOut.rehearsed = static_cast<int>(
        std::erase_if(answers.counted, [](const Answer& answer) { return answer.row.rehearsal; }));
    if (answers.counted.empty() && answers.leftOut.rehearsed > 0)
        throw Error(fmt::format("expected answers of a study, found rehearsals only: {} rows in {} "
                                "file(s), which do not count",
                                answers.leftOut.rehearsed, answers.files));
}

// Rows may differ in their texts, but not in their design. Rows of a version that kept no design
// count as of the same one if they come from the same protocol file.
bool sameDesign(const Response& x, const Response& y) {
    const bool known = !x.designSha256.empty() && !y.designSha256.empty();
    return known ? x.designSha256 == y.designSha256 : x.protocolSha256 == y.protocolSha256;
}

void requireOneDesign(const std::vector<Answer>& answers) {
    std::map<std::string, std::vector<const Answer*>> kinds; // by study, as they came
    for (const Answer& answer : answers) {
        auto& known = kinds[answer.row.studyId];
        const auto alike = [&](const Answer* other) { return sameDesign(answer.row, other->row); };
        if (!known.empty() && std::none_of(known.begin(), known.end(), alike))
            refuse(answer, "design_sha256",
                   fmt::format("a design of study \"{}\" other than in {} (protocol {:.12}..., not "
                               "{:.12}...); --allow-mixed-protocols pools them",
                               answer.row.studyId, at(*known.front()), answer.row.protocolSha256,
                               known.front()->row.protocolSha256));
        const auto equal = [&](const Answer* other) {
            return answer.row.designSha256 == other->row.designSha256 &&
                   answer.row.protocolSha256 == other->row.protocolSha256;
        };
        if (std::none_of(known.begin(), known.end(), equal))
            known.push_back(&answer);
    }
}

void requireOneStudy(const std::vector<Answer>& answers) {
    for (const Answer& answer : answers)
        if (const Answer& first = answers.front(); answer.row.studyId != first.row.studyId)
            refuse(answer, "study_id",
                   fmt::format("expected \"{}\" as in {}, found \"{}\"; --allow-mixed-studies "
                               "pools them",
                               first.row.studyId, at(first), answer.row.studyId));
}

std::string folded(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return text;
}

int columnNumber(std::string_view name) {
    const auto columns = responseColumns();
    const auto found = std::find_if(columns.begin(), columns.end(),
                                    [&](const Column& column) { return column.name == name; });
    return 1 + static_cast<int>(found - columns.begin());
}

// `S01` and `s01` are one person, written twice.
template <auto field>
void requireOneSpelling(const std::vector<Answer>& answers, std::string_view column) {
    std::map<std::pair<std::string, std::string>, const Answer*> seen;
    for (const Answer& answer : answers) {
        const std::string& name = answer.row.*field;
        const auto [first, isNew] = seen.try_emplace({answer.row.studyId, folded(name)}, &answer);
        if (const Answer& other = *first->second; other.row.*field != name)
            throw Error(
                {answer.place.file, answer.place.line, columnNumber(column), std::string(column)},
                fmt::format("expected \"{}\" as in {}, found \"{}\"; write it one way in all "
                            "rows, or with more than a letter's case between them",
                            other.row.*field, at(other), name));
    }
}

void requireOneSpelling(const std::vector<Answer>& answers) {
    requireOneSpelling<&Response::participantId>(answers, "participant_id");
    requireOneSpelling<&Response::conditionId>(answers, "condition_id");
    requireOneSpelling<&Response::level>(answers, "level");
    requireOneSpelling<&Response::scene>(answers, "scene");
}

using Key = std::vector<std::string>;

// Leaves out each row whose key an earlier row has, or refuses it.
int removeRepeated(std::vector<Answer>& answers, std::string_view column, bool allowed,
                   Key (*key)(const Response&)) {
    std::map<Key, std::string> seen;
    const auto repeated = [&](const Answer& answer) {
        const auto [first, isNew] = seen.try_emplace(key(answer.row), at(answer));
        if (!isNew && !allowed)
            refuse(answer, column,
                   fmt::format("{} was answered before, in {}; --allow-duplicates counts the "
                               "first of such rows and leaves out the others",
                               fmt::join(first->first, " "), first->second));
        return !isNew;
    };
    std::vector<Answer> kept;
    std::copy_if(answers.begin(), answers.end(), std::back_inserter(kept), std::not_fn(repeated));
    const auto removed = answers.size() - kept.size();
    answers = std::move(kept);
    return static_cast<int>(removed);
}

int removeDuplicates(std::vector<Answer>& answers, bool allowed) {
    const auto rowId = [](const Response& row) { return Key{row.studyId, "row", row.rowId}; };
    const auto trial = [](const Response& row) {
        return Key{row.studyId,       "participant",
                   row.participantId, "session",
                   row.sessionId,     row.trialKind,
                   "condition",       row.conditionId,
                   "repeat",          std::to_string(row.repeatIndex)};
    };
    return removeRepeated(answers, "row_id", allowed, rowId) +
           removeRepeated(answers, "condition_id", allowed, trial);
}

int removeKind(std::vector<Answer>& answers, std::string_view kind) {
    return static_cast<int>(
        std::erase_if(answers, [&](const Answer& a) { return a.row.trialKind == kind; }));
}

// What the presenter has kept of the protocol beside the data; nothing where it has not.
void readOrder(const fs::path& folder, std::vector<std::string>& order) {
    const fs::path path = folder / "sessions" / "design.json";
    if (fs::exists(path))
        for (const std::string& condition : conditionOrder(readFile(path), path.string()))
            order.push_back(condition);
}

Answers readAll(const std::vector<fs::path>& files, bool lenient) {
    Answers answers;
    for (const fs::path& file : files) {
        ResponseFile read = readResponses(file, lenient);
        for (std::size_t i = 0; i < read.rows.size(); ++i)
            answers.counted.push_back(
                {std::move(read.rows[i]), {file.string(), read.lines[i], 0, {}}});
        answers.bad.insert(answers.bad.end(), read.bad.begin(), read.bad.end());
        ++answers.files;
        answers.earlierFiles += read.version < Response().schemaVersion;
    }
    return answers;
}

} // namespace

Answers collectAnswers(std::span<const fs::path> data, const AnswerRules& rules) {
    Answers answers = readAll(filesOf(data), rules.lenient);
    for (const fs::path& given : data)
        readOrder(given, answers.order);
    std::vector<Answer>& rows = answers.counted;
    removeRehearsals(answers);
    removeSimulated(rows, rules.simulated, answers.leftOut);
    if (!rules.mixedStudies)
        requireOneStudy(rows);
    if (!rules.mixedProtocols)
        requireOneDesign(rows);
    requireOneSpelling(rows);
    answers.leftOut.duplicates = removeDuplicates(rows, rules.duplicates);
    answers.leftOut.practice = removeKind(rows, "practice");
    answers.leftOut.catches = removeKind(rows, "catch");
    if (!rules.interrupted)
        answers.leftOut.interrupted = static_cast<int>(
            std::erase_if(rows, [](const Answer& a) { return a.row.interrupted; }));
    if (rows.empty())
        throw Error(fmt::format("expected answers to main trials, found none in {} file(s)",
                                answers.files));
    return answers;
}

} // namespace obscura
