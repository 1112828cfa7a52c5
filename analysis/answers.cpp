#include "analysis/answers.h"

#include "base/csv.h"
#include "base/files.h"
#include "base/parallel.h"
#include "protocols/reader/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <functional>
#include <map>
#include <unordered_set>

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
        throw Error({folder.string(), 0, 0, {}}, "expected CSV files of responses, found none");
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

std::string at(const Answer& answer) { return fmt::format("{}:{}", answer.file, answer.line); }

[[noreturn]] void refuse(const Answer& answer, std::string_view column, const std::string& why) {
    throw Error(answer.place(column), why);
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
bool sameDesign(const Vote& x, const Vote& y) {
    const bool known = x.designSha256 != Symbol() && y.designSha256 != Symbol();
    return known ? x.designSha256 == y.designSha256 : x.protocolSha256 == y.protocolSha256;
}

void requireOneDesign(const std::vector<Answer>& answers) {
    std::map<std::uint32_t, std::vector<const Answer*>> kinds; // by study, as they came
    for (const Answer& answer : answers) {
        auto& known = kinds[answer.row.studyId.number()];
        const auto alike = [&](const Answer* other) { return sameDesign(answer.row, other->row); };
        if (!known.empty() && std::none_of(known.begin(), known.end(), alike))
            refuse(answer, "design_sha256",
                   fmt::format("a design of study \"{}\" other than in {} (protocol {:.12}..., not "
                               "{:.12}...); --allow-mixed-protocols pools them",
                               answer.row.studyId, at(*known.front()),
                               answer.row.protocolSha256.text(),
                               known.front()->row.protocolSha256.text()));
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

int columnNumber(std::string_view name) {
    const auto columns = responseColumns();
    const auto found = std::find_if(columns.begin(), columns.end(),
                                    [&](const Column& column) { return column.name == name; });
    return 1 + static_cast<int>(found - columns.begin());
}

// `S01` and `s01` are one person, written twice.
template <auto field>
void requireOneSpelling(const std::vector<Answer>& answers, std::string_view column, int number) {
    std::map<std::pair<std::uint32_t, std::string>, const Answer*> seen;
    std::unordered_set<std::uint64_t> known; // study and name
    Symbol aboveStudy, above; // no study is "", and most rows have the name of the row above
    for (const Answer& answer : answers) {
        const Symbol study = answer.row.studyId, name = answer.row.*field;
        if (name == above && study == aboveStudy)
            continue;
        aboveStudy = study;
        above = name;
        if (!known.insert(std::uint64_t{study.number()} << 32 | name.number()).second)
            continue;
        const auto [first, isNew] = seen.try_emplace({study.number(), folded(name)}, &answer);
        if (const Answer& other = *first->second; other.row.*field != name)
            throw Error(
                {answer.file, answer.line, number, std::string(column)},
                fmt::format("expected \"{}\" as in {}, found \"{}\"; write it one way in all "
                            "rows, or with more than a letter's case between them",
                            other.row.*field, at(other), name));
    }
}

void requireOneSpelling(const std::vector<Answer>& answers,
                        const std::function<int(std::string_view)>& number) {
    requireOneSpelling<&Vote::participantId>(answers, "participant_id", number("participant_id"));
    requireOneSpelling<&Vote::conditionId>(answers, "condition_id", number("condition_id"));
    requireOneSpelling<&Vote::level>(answers, "level", number("level"));
    requireOneSpelling<&Vote::scene>(answers, "scene", number("scene"));
}

// What two rows must not share.
using Key = std::array<std::uint64_t, 3>;

Key rowOf(const Vote& row) { return {row.studyId.number(), row.rowIdHash[0], row.rowIdHash[1]}; }

Key trialOf(const Vote& row) {
    const auto both = [](std::uint64_t high, std::uint64_t low) { return high << 32 | low; };
    return {both(row.studyId.number(), row.participantId.number()),
            both(row.sessionId.number(), row.trialKind.number()),
            both(row.conditionId.number(), static_cast<std::uint32_t>(row.repeatIndex))};
}

std::string inWords(const Vote& row) {
    return fmt::format("{} participant {} session {} {} condition {} repeat {}", row.studyId,
                       row.participantId, row.sessionId, row.trialKind, row.conditionId,
                       row.repeatIndex);
}

// Leaves out each row whose key an earlier row has, or refuses it.
int removeRepeated(std::vector<Answer>& answers, std::string_view column, bool allowed,
                   Key (*key)(const Vote&)) {
    std::vector<std::pair<Key, std::uint32_t>> keys;
    keys.reserve(answers.size());
    for (const Answer& answer : answers)
        keys.emplace_back(key(answer.row), static_cast<std::uint32_t>(keys.size()));
    std::sort(keys.begin(), keys.end()); // of equal ones, as they came
    std::vector<bool> repeats(answers.size());
    std::size_t first = answers.size(); // of the repeats
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i].first == keys[i - 1].first) {
            repeats[keys[i].second] = true;
            first = std::min<std::size_t>(first, keys[i].second);
        }
    if (first == answers.size())
        return 0;
    if (!allowed) {
        const Answer& answer = answers[first];
        const auto original = std::find_if(answers.begin(), answers.end(), [&](const Answer& one) {
            return key(one.row) == key(answer.row);
        });
        refuse(answer, column,
               fmt::format("{} was answered before, in {}; --allow-duplicates counts the first of "
                           "such rows and leaves out the others",
                           inWords(answer.row), at(*original)));
    }
    std::size_t index = 0;
    return static_cast<int>(
        std::erase_if(answers, [&](const Answer&) { return repeats[index++]; }));
}

int removeDuplicates(std::vector<Answer>& answers, bool allowed) {
    return removeRepeated(answers, "row_id", allowed, rowOf) +
           removeRepeated(answers, "condition_id", allowed, trialOf);
}

int removeKind(std::vector<Answer>& answers, std::string_view kind) {
    return static_cast<int>(std::erase_if(
        answers, [name = Symbol(kind)](const Answer& a) { return a.row.trialKind == name; }));
}

// What the presenter has kept beside the data; nothing where it has not.
std::optional<Declared> readDeclared(const fs::path& folder) {
    const fs::path path = folder / "sessions" / "design.json";
    return fs::exists(path) ? std::optional(declaredIn(readFile(path), path.string()))
                            : std::nullopt;
}

// Claims are worth something if they are those under which the answers were given.
void checkDeclared(const Declared& declared, const fs::path& folder,
                   const std::vector<Answer>& rows) {
    if (declared.claims.empty() && declared.exclusions == ExclusionRules())
        return;
    const Symbol hash(declared.sha256);
    const auto alike = [&](const Answer& answer) {
        return answer.row.designSha256 == hash || answer.row.designSha256 == Symbol();
    };
    if (!rows.empty() && std::none_of(rows.begin(), rows.end(), alike))
        throw Error({(folder / "sessions" / "design.json").string(), 0, 0, {}},
                    fmt::format("expected the design under which the answers were given "
                                "({:.12}..., as {} says), found one of the hash {:.12}...; what it "
                                "claims was declared for other data. Put the original back, or "
                                "remove the file",
                                rows.front().row.designSha256.text(), at(rows.front()),
                                declared.sha256));
}

// The folders of studies in which the data lie, each once: a study's folder, the folder data in it,
// or a file in that.
std::vector<fs::path> studyFolders(std::span<const fs::path> data) {
    std::vector<fs::path> folders;
    for (const fs::path& given : data) {
        fs::path folder = fs::canonical(given);
        for (int up = 0; up < 2 && !fs::exists(folder / "sessions"); ++up)
            folder = folder.parent_path();
        if (fs::exists(folder / "sessions") &&
            std::find(folders.begin(), folders.end(), folder) == folders.end())
            folders.push_back(folder);
    }
    return folders;
}

void declare(std::span<const fs::path> data, bool mixed, Answers& answers) {
    bool known = false;
    for (const fs::path& folder : studyFolders(data)) {
        for (SlotRecord& slot : readSlots(folder / "sessions" / "ledger.jsonl"))
            answers.slots.push_back(std::move(slot));
        const auto declared = readDeclared(folder);
        if (!declared)
            continue;
        const bool other = known && (declared->claims != answers.declared.claims ||
                                     declared->exclusions != answers.declared.exclusions);
        if (other && !mixed)
            throw Error({(folder / "sessions" / "design.json").string(), 0, 0, {}},
                        "declares other claims or exclusions than the folders before it; analyse "
                        "them one by one, or --allow-mixed-protocols and nothing counts as "
                        "declared");
        if (!mixed)
            checkDeclared(*declared, folder, answers.counted);
        if (other) {
            answers.declared.claims.clear();
            answers.declared.exclusions = {};
        } else if (!known) {
            answers.declared = *declared;
        }
        known = true;
    }
}

struct FileRows {
    std::vector<Answer> rows;
    ResponseRows read;
    std::exception_ptr error;
};

FileRows readFileRows(const fs::path& path, bool lenient, const FilePart& part = {}) {
    FileRows file;
    const Symbol name(path.string());
    try {
        file.read = eachResponse(
            path, lenient,
            [&](const Response& row, int line) {
                const Vote above = file.rows.empty() ? Vote() : file.rows.back().row;
                file.rows.push_back({Vote(row, above), name, line});
            },
            part);
    } catch (...) {
        file.error = std::current_exception();
    }
    return file;
}

// What is read at once: a small file, or a part of a large one.
struct Piece {
    const fs::path* file;
    FilePart part;
};

std::vector<Piece> piecesOf(std::span<const fs::path> files) {
    constexpr std::int64_t most = std::int64_t{1} << 23; // bytes
    std::vector<Piece> pieces;
    for (const fs::path& file : files) {
        std::error_code unknown; // is told when the file is read
        const auto size = static_cast<std::int64_t>(fs::file_size(file, unknown));
        pieces.push_back({&file, {}});
        for (std::int64_t begin = most; !unknown && begin < size; begin += most) {
            pieces.back().part.end = begin;
            pieces.push_back({&file, {.begin = begin}});
        }
    }
    return pieces;
}

// The pieces are the file: none has an error, and each ends where the next begins.
bool areWhole(std::span<const FileRows> pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (pieces[i].error || (i > 0 && pieces[i].read.read.begin != pieces[i - 1].read.read.end))
            return false;
    return true;
}

// The rows of one file; frees them in the pieces.
void add(std::span<FileRows> pieces, Answers& answers) {
    int above = 0; // lines
    for (FileRows& piece : pieces) {
        if (piece.error)
            std::rethrow_exception(piece.error);
        for (Answer& answer : piece.rows) {
            answer.line += above;
            answers.counted.push_back(answer);
        }
        for (BadRow& bad : piece.read.bad) {
            bad.place.line += above;
            answers.bad.push_back(std::move(bad));
        }
        above += piece.read.lines;
        piece.rows = {};
    }
    ++answers.files;
    answers.earlierFiles += pieces.front().read.version < Response().schemaVersion;
}

// Several files at once, and parts of large ones; of their errors the first is thrown. A file of
// several parts is read again, from its begin, if there is an error (its line is not known) or if a
// part began within a cell of several lines.
void readTogether(std::span<const fs::path> files, bool lenient, Answers& answers) {
    const std::vector<Piece> pieces = piecesOf(files);
    std::vector<FileRows> read(pieces.size());
    forEachInParallel(read.size(), [&](std::size_t i) {
        read[i] = readFileRows(*pieces[i].file, lenient, pieces[i].part);
    });
    std::size_t rows = answers.counted.size();
    for (const FileRows& piece : read)
        rows += piece.rows.size();
    if (answers.counted.empty())
        answers.counted.reserve(rows);
    for (std::size_t begin = 0, end = 0; begin < read.size(); begin = end) {
        while (end < read.size() && pieces[end].file == pieces[begin].file)
            ++end;
        std::span<FileRows> file = std::span(read).subspan(begin, end - begin);
        if (file.size() > 1 && !areWhole(file)) {
            file.front() = readFileRows(*pieces[begin].file, lenient);
            file = file.first(1);
        }
        add(file, answers);
    }
}

Answers readAll(std::span<const fs::path> files, bool lenient) {
    constexpr std::size_t together = 512; // so that few rows are held twice
    Answers answers;
    for (std::size_t begin = 0; begin < files.size(); begin += together)
        readTogether(files.subspan(begin, std::min(together, files.size() - begin)), lenient,
                     answers);
    return answers;
}

} // namespace

std::string folded(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return text;
}

Answers collectAnswers(std::span<const fs::path> data, const AnswerRules& rules) {
    Answers answers = readAll(filesOf(data), rules.lenient);
    applyRules(answers, data, rules, {columnNumber, true});
    return answers;
}

void applyRules(Answers& answers, std::span<const fs::path> data, const AnswerRules& rules,
                const TableForm& form) {
    std::vector<Answer>& rows = answers.counted;
    removeRehearsals(answers);
    removeSimulated(rows, rules.simulated, answers.leftOut);
    if (!rules.mixedStudies)
        requireOneStudy(rows);
    if (!rules.mixedProtocols)
        requireOneDesign(rows);
    requireOneSpelling(rows, form.columnNumber);
    declare(data, rules.mixedProtocols, answers);
    answers.leftOut.duplicates = removeDuplicates(rows, rules.duplicates);
    answers.leftOut.practice = removeKind(rows, "practice");
    Declared declared = answers.declared;
    if (!form.isChoice) { // these ask which image was chosen
        declared.exclusions.catches = 0;
        declared.exclusions.onePosition = 1;
    }
    answers.excluded = exclude(rows, declared, answers.slots, rules.excluded);
    removeKind(answers.excluded.rows, "catch");
    answers.leftOut.catches = removeKind(rows, "catch");
    if (!rules.interrupted)
        answers.leftOut.interrupted = static_cast<int>(
            std::erase_if(rows, [](const Answer& a) { return a.row.interrupted; }));
    if (rows.empty() && !answers.excluded.rows.empty())
        throw Error(fmt::format("expected answers that count, found none: all {} are excluded "
                                "(first: {})",
                                answers.excluded.rows.size(),
                                answers.excluded.reasons.front().reason));
    if (rows.empty())
        throw Error(fmt::format("expected answers to main trials, found none in {} file(s)",
                                answers.files));
}

} // namespace obscura
