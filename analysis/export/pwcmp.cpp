#include "analysis/export/formats.h"
#include "analysis/export/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace obscura {

namespace {

// What one answer says of two techniques.
struct Comparison {
    std::string observer, session, scene, first, second, level, condition, criterion, rowId;
    std::optional<bool> firstChosen; // none: unsure
};

// Questions that are answered with an image; others have options of their own.
std::set<std::string> questionsOfImages(const RecordedStudy& data) {
    std::set<std::string> names;
    for (const SessionData& session : data.sessions)
        for (const auto& [row, place] : session.answers)
            if (row.kind == "choice" && !row.role.empty())
                names.insert(row.question);
    return names;
}

class PwcmpComparisons {
  public:
    explicit PwcmpComparisons(const RecordedStudy& data) : questions_(questionsOfImages(data)) {
        for (const SessionData& session : data.sessions) {
            for (const auto& [row, place] : session.answers)
                add(row, place);
            if (session.answers.empty()) // from before there were tables of answers
                for (const auto& [row, place] : session.rows)
                    add(row);
        }
    }

    const std::vector<Comparison>& found() const { return found_; }
    int others() const { return others_; }   // answers that choose among more than two
    int missing() const { return missing_; } // questions left open
    bool ties() const {
        return std::any_of(found_.begin(), found_.end(),
                           [](const Comparison& c) { return !c.firstChosen; });
    }

  private:
    void add(const AnswerRow& row, const Place& place) {
        const TrialKey& trial = row.trial;
        if (trial.trialKind != "main" || row.kind == "rank")
            others_ += trial.trialKind == "main";
        else if (row.kind == "choice" && questions_.count(row.question)) {
            const std::vector<std::string> roles = split(trial.roles, '>'),
                                           techniques = split(trial.techniques, '>');
            if (roles.size() != techniques.size())
                throw Error({place.file, place.line, 0, "techniques"},
                            fmt::format("expected a technique for each of the roles {}, found {}",
                                        trial.roles, trial.techniques));
            if (roles.size() != 2 || techniques[0] == techniques[1])
                ++others_;
            else if (row.role.empty() && row.value != "unsure")
                ++missing_;
            else
                found_.push_back({trial.participantId, trial.sessionId, trial.scene, techniques[0],
                                  techniques[1], trial.level, trial.conditionId, row.question,
                                  trial.rowId, chosen(row, roles, place)});
        }
    }

    static std::optional<bool> chosen(const AnswerRow& row, const std::vector<std::string>& roles,
                                      const Place& place) {
        if (row.role.empty())
            return std::nullopt;
        if (std::find(roles.begin(), roles.end(), row.role) == roles.end())
            throw Error(
                {place.file, place.line, 0, "role"},
                fmt::format("expected {} or {}, found \"{}\"", roles[0], roles[1], row.role));
        return row.role == roles[0];
    }

    void add(const Response& row) {
        if (row.trialKind != "main")
            return;
        if (row.techniqueA == row.techniqueB) {
            ++others_;
            return;
        }
        const bool aFirst = row.firstIs == "a";
        found_.push_back({row.participantId, row.sessionId, row.scene,
                          aFirst ? row.techniqueA : row.techniqueB,
                          aFirst ? row.techniqueB : row.techniqueA, row.level, row.conditionId,
                          "choice", row.rowId, row.chosenPosition == 1});
    }

    std::set<std::string> questions_;
    std::vector<Comparison> found_;
    int others_ = 0, missing_ = 0;
};

std::string readme(const RecordedStudy& data, bool ties) {
    return fmt::format(
        "# {}: comparisons for pwcmp\n\n"
        "comparisons.csv has a line for each choice between two images: condition_A was the first\n"
        "in the trial, condition_B the second, is_A_selected says which was chosen. Practice and\n"
        "catch trials are left out.\n\n"
        "    R = pw_scale_table(readtable('comparisons.csv'), 'scene', {{'condition_A', \n"
        "            'condition_B'}}, 'observer', 'is_A_selected')\n\n"
        "Where the study has several levels or questions (criterion), scale each on its own.\n{}",
        data.study,
        ties ? "\nSome answers were \"not sure\", which pwcmp has no place for. Every answer "
               "therefore has two\nlines: a decided one the same line twice, an undecided one a "
               "line for each image. Both lines\nhave one row_id. An undecided answer so counts as "
               "half a choice of either image. All counts\nare doubled, which leaves maximum "
               "likelihood scales (prior 'none') and bootstrap intervals\nover observers where "
               "they would be; do not take the number of lines for that of answers.\n"
             : "");
}

} // namespace

NewFiles pwcmpFiles(const RecordedStudy& data, std::vector<std::string>& remarks) {
    const PwcmpComparisons comparisons(data);
    if (comparisons.others() > 0)
        remarks.push_back(fmt::format("{} answer(s) are no choice between two techniques (ranks, "
                                      "more than two images, one technique twice) and were left "
                                      "out",
                                      comparisons.others()));
    if (comparisons.missing() > 0)
        remarks.push_back(
            fmt::format("{} question(s) were left open, and left out", comparisons.missing()));
    if (comparisons.found().empty())
        throw Error("expected choices between two images in main trials, which pwcmp scales, found "
                    "none; other answers are in --format bids and psych-ds");
    ExportTable table;
    for (const char* name : {"observer", "session_id", "scene", "condition_A", "condition_B",
                             "is_A_selected", "level", "condition_id", "criterion", "row_id"})
        table.columns.push_back({name, {}, {}});
    const bool ties = comparisons.ties();
    for (const Comparison& c : comparisons.found())
        for (int line = 0; line < (ties ? 2 : 1); ++line)
            table.rows.push_back({c.observer, c.session, c.scene, c.first, c.second,
                                  c.firstChosen.value_or(line == 0) ? "1" : "0", c.level,
                                  c.condition, c.criterion, c.rowId});
    if (ties)
        remarks.push_back("some answers are \"not sure\": every answer has two lines, so that "
                          "these count as half a choice of either image (README.md)");
    return {{"comparisons.csv", {csvText(table)}}, {"README.md", {readme(data, ties)}}};
}

} // namespace obscura
