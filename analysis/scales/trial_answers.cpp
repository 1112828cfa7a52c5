#include "analysis/scales/trial_answers.h"

#include "base/csv.h"
#include "base/files.h"
#include "protocols/reader/trial_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace obscura {

namespace fs = std::filesystem;

namespace {

bool isAnswerTable(const fs::path& path) {
    return path.filename().string().ends_with("_answers.csv") &&
           !path.filename().string().starts_with('.');
}

bool hasRowsOfPairs(const fs::path& folder) {
    const fs::path data = fs::is_directory(folder / "data") ? folder / "data" : folder;
    return std::any_of(fs::directory_iterator(data), fs::directory_iterator(), [](const auto& e) {
        return e.is_regular_file() && e.path().extension() == ".csv" && !isAnswerTable(e.path()) &&
               !e.path().filename().string().ends_with("_phases.csv");
    });
}

std::vector<fs::path> tablesIn(const fs::path& folder) {
    std::vector<fs::path> tables;
    const fs::path sessions = fs::is_directory(folder / "sessions") ? folder / "sessions" : folder;
    for (const fs::directory_entry& entry : fs::directory_iterator(sessions))
        if (entry.is_regular_file() && isAnswerTable(entry.path()))
            tables.push_back(entry.path());
    std::sort(tables.begin(), tables.end());
    return tables;
}

bool isTrialData(const fs::path& path) {
    if (fs::is_directory(path))
        return !hasRowsOfPairs(path) && !tablesIn(path).empty();
    return fs::is_regular_file(path) && isAnswerTable(path);
}

int answerColumn(std::string_view name) {
    static const std::vector<TableColumn> columns = answerColumns();
    const auto found = std::find_if(columns.begin(), columns.end(),
                                    [&](const TableColumn& column) { return column.name == name; });
    return 1 + static_cast<int>(found - columns.begin());
}

std::vector<std::string> parts(const std::string& text) { // of "b>a"
    std::vector<std::string> list;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('>', begin), text.size());
        list.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return list;
}

// "2026-01-31T23:59:59Z", which a time is read from.
bool isTime(const std::string& text) {
    constexpr std::string_view form = "0000-00-00T00:00:00Z";
    return text.size() == form.size() &&
           std::equal(text.begin(), text.end(), form.begin(), [](char c, char wanted) {
               return wanted == '0' ? c >= '0' && c <= '9' : c == wanted;
           });
}

// What is wrong with a row beyond its cells, and in which column.
std::pair<std::string, std::string> faultOf(const AnswerRow& row) {
    const std::vector<std::string> roles = parts(row.trial.roles);
    double number = 0;
    if (!isTime(row.wallTimeUtc))
        return {"wall_time_utc", fmt::format("expected a time such as 2026-01-31T23:59:59Z, found "
                                             "\"{}\"",
                                             row.wallTimeUtc)};
    if (roles.size() != parts(row.trial.techniques).size())
        return {"techniques", fmt::format("expected a technique for each of the roles \"{}\", "
                                          "found \"{}\"",
                                          row.trial.roles, row.trial.techniques)};
    if (row.value.empty())
        return {};
    const bool isNumber = readCell(row.value, number);
    if ((row.kind == "scale" || row.kind == "slider") && !isNumber)
        return {"value", fmt::format("expected a number of a {}, found \"{}\"", row.kind, //
                                     row.value)};
    if (row.kind == "choice" && row.value != "unsure" && !(isNumber && number >= 1))
        return {"value",
                fmt::format("expected the number of an option or unsure, found \"{}\"", row.value)};
    for (const std::string& role : parts(row.role))
        if (std::find(roles.begin(), roles.end(), role) == roles.end())
            return {"role", fmt::format("expected one of the roles \"{}\", found \"{}\"",
                                        row.trial.roles, role)};
    const std::set<std::string> ranked = [&] {
        const std::vector<std::string> list = parts(row.role);
        return std::set<std::string>(list.begin(), list.end());
    }();
    if (row.kind == "rank" && (ranked.size() != parts(row.role).size() || ranked.empty()))
        return {"role", fmt::format("expected the roles that were ranked, each once, found \"{}\"",
                                    row.role)};
    return {};
}

Vote voteOf(const AnswerRow& row) {
    Response response;
    response.rowId = fmt::format("{}-{}-{}-{}", row.trial.participantId, row.trial.sessionId,
                                 row.trial.trialKind, row.trial.trialIndex);
    response.studyId = row.trial.studyId;
    response.participantId = row.trial.participantId;
    response.sessionId = row.trial.sessionId;
    response.conditionId = row.trial.conditionId;
    response.level = row.trial.level;
    response.scene = row.trial.scene;
    response.hypothesis = row.trial.hypothesis;
    response.trialKind = row.trial.trialKind;
    response.trialIndex = row.trial.trialIndex;
    response.repeatIndex = row.trial.repeatIndex;
    response.slotId = row.trial.slotId;
    response.simulated = row.trial.simulated;
    response.rehearsal = row.trial.rehearsal;
    response.interrupted = row.interrupted;
    response.decisionRtMs = row.responseMs;
    response.appVersion = row.appVersion;
    response.gitCommit = row.gitCommit;
    response.protocolSha256 = row.protocolSha256;
    response.designSha256 = row.designSha256;
    response.machineId = row.machineId;
    response.wallTimeUtc = row.wallTimeUtc;
    return Vote(response);
}

bool choosesOfTwo(const AnsweredTrial& trial) {
    const std::set<std::string> roles(trial.roles.begin(), trial.roles.end());
    return roles == std::set<std::string>{"a", "b"} &&
           std::any_of(trial.given.begin(), trial.given.end(), [](const Given& given) {
               return given.kind.text() == "choice" && given.role != Symbol();
           });
}

// Of one file, trial by trial, whatever the order of its lines.
class TableReader {
  public:
    TableReader(TrialAnswers& study, const fs::path& path, const AnswerRules& rules)
        : study_(study), file_(path.string()), rules_(rules) {
        const fs::path design = path.parent_path() / "design.json";
        auto& known = study.designs[path.parent_path().string()];
        if (!known && fs::exists(design))
            known =
                std::make_shared<const DesignFacts>(designFacts(readFile(design), design.string()));
        design_ = known.get();
        const TrialTable<AnswerRow> table = readAnswers(path, rules.lenient);
        study.answers.bad.insert(study.answers.bad.end(), table.bad.begin(), table.bad.end());
        ++study.answers.files;
        for (std::size_t i = 0; i < table.rows.size(); ++i)
            add(table.rows[i], table.lines[i]);
    }

  private:
    void add(const AnswerRow& row, int line) {
        if (row.trial.trialKind == "before" || row.trial.trialKind == "after")
            return; // pages around the trials: forms, which are no results
        if (const auto& [column, fault] = faultOf(row); !fault.empty()) {
            const BadRow bad{{file_, line, answerColumn(column), column}, fault};
            if (!rules_.lenient)
                throw Error(bad.place, bad.message + "; --lenient skips it");
            study_.answers.bad.push_back(bad);
            return;
        }
        const auto key = std::tuple(row.trial.studyId, row.trial.participantId, //
                                    row.trial.sessionId, row.trial.trialKind, row.trial.trialIndex);
        const auto [found, isNew] = index_.try_emplace(key, study_.trials.size());
        if (isNew)
            study_.trials.push_back({{voteOf(row), Symbol(file_), line},
                                     parts(row.trial.roles),
                                     parts(row.trial.techniques),
                                     {},
                                     design_});
        AnsweredTrial& trial = study_.trials[found->second];
        for (const Given& given : trial.given)
            if (given.question.text() == row.question) {
                if (!rules_.duplicates)
                    throw Error({file_, line, answerColumn("question"), "question"},
                                fmt::format("\"{}\" of this trial was answered before, in line {}; "
                                            "--allow-duplicates counts the first of such rows and "
                                            "leaves out the others",
                                            row.question, given.line));
                ++study_.answers.leftOut.duplicates;
                return;
            }
        trial.given.push_back(
            {Symbol(row.question), Symbol(row.kind), Symbol(row.value), Symbol(row.role), line});
    }

    TrialAnswers& study_;
    std::string file_;
    const AnswerRules& rules_;
    const DesignFacts* design_ = nullptr;
    std::map<std::tuple<std::string, std::string, std::string, std::string, int>, std::size_t>
        index_;
};

} // namespace

std::string AnsweredTrial::techniqueOf(const std::string& role) const {
    const auto place = std::find(roles.begin(), roles.end(), role);
    if (place != roles.end())
        return techniques[static_cast<std::size_t>(place - roles.begin())];
    if (!design)
        return {};
    const auto condition = design->conditions.find(trial.row.conditionId);
    if (condition == design->conditions.end())
        return {};
    const auto technique = condition->second.techniques.find(role);
    return technique == condition->second.techniques.end() ? std::string() : technique->second;
}

bool isTrialData(std::span<const fs::path> data) {
    const auto other = std::find_if(data.begin(), data.end(),
                                    [](const fs::path& path) { return !isTrialData(path); });
    const auto trials = std::find_if(data.begin(), data.end(),
                                     [](const fs::path& path) { return isTrialData(path); });
    if (trials != data.end() && other != data.end())
        throw Error({other->string(), 0, 0, {}},
                    fmt::format("expected tables of answers (sessions/*_answers.csv) as in {}, "
                                "found rows of pairs or nothing; analyse the two on their own",
                                trials->string()));
    return trials != data.end();
}

TrialAnswers collectTrials(std::span<const fs::path> data, const AnswerRules& rules) {
    TrialAnswers study;
    std::set<fs::path> known;
    for (const fs::path& given : data)
        for (const fs::path& file :
             fs::is_directory(given) ? tablesIn(given) : std::vector<fs::path>{given})
            if (known.insert(fs::canonical(file)).second)
                TableReader(study, file, rules);
    for (const AnsweredTrial& trial : study.trials)
        study.answers.counted.push_back(trial.trial);
    study.isChoice = std::all_of(study.trials.begin(), study.trials.end(), choosesOfTwo);
    const int within = study.answers.leftOut.duplicates; // trials
    applyRules(study.answers, data, rules, {answerColumn, study.isChoice});
    study.answers.leftOut.duplicates += within;

    std::vector<AnsweredTrial> all = std::move(study.trials);
    study.trials.clear();
    const auto keys = [](const std::vector<Answer>& rows) {
        std::set<std::pair<std::uint32_t, int>> places; // file and line
        for (const Answer& row : rows)
            places.insert({row.file.number(), row.line});
        return places;
    };
    const auto counted = keys(study.answers.counted), excluded = keys(study.answers.excluded.rows);
    for (AnsweredTrial& trial : all) {
        const auto key = std::pair(trial.trial.file.number(), trial.trial.line);
        if (counted.contains(key))
            study.trials.push_back(std::move(trial));
        else if (excluded.contains(key))
            study.excluded.push_back(std::move(trial));
    }
    return study;
}

} // namespace obscura
