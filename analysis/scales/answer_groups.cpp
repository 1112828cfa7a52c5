#include "analysis/scales/answer_groups.h"

#include "base/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace obscura {

const DesignFacts::Asked* askedOf(const AnsweredTrial& trial, const Given& given) {
    if (!trial.design)
        return nullptr;
    const auto asked = trial.design->questions.find(given.question);
    return asked == trial.design->questions.end() ? nullptr : &asked->second;
}

std::string correctOf(const AnsweredTrial& trial) {
    if (!trial.design)
        return {};
    const auto condition = trial.design->conditions.find(trial.trial.row.conditionId);
    return condition == trial.design->conditions.end() ? "" : condition->second.correct;
}

double numberOf(const Given& given) {
    double number = 0;
    readCell(given.value.text(), number);
    return number;
}

namespace {

// The study's answers, sorted.
class Sorter {
  public:
    explicit Sorter(const TrialAnswers& study) : study_(study) {
        for (const auto& [folder, design] : study.designs)
            if (design && !design->boostReference.empty())
                result_.pivot = design->boostReference;
        order();
        for (const AnsweredTrial& trial : study.trials)
            for (const Given& given : trial.given)
                if (given.value != Symbol() && askedOf(trial, given) == nullptr &&
                    (given.kind.text() == "scale" || given.kind.text() == "slider") &&
                    numberOf(given) < 0)
                    signed_.insert(given.question);
        for (const AnsweredTrial& trial : study.trials)
            sort(trial);
        placeGroups();
    }

    AnswerGroups result() && { return std::move(result_); }

  private:
    void placeGroups() {
        const auto place = [&](const AnswerGroup& group) { // of its first condition in the protocol
            std::size_t first = result_.conditions.size();
            for (const Observation& one : group.members)
                first = std::min(first,
                                 static_cast<std::size_t>(
                                     std::find(result_.conditions.begin(), result_.conditions.end(),
                                               one.trial->trial.row.conditionId.text()) -
                                     result_.conditions.begin()));
            return std::pair(group.group.isPooled(), first);
        };
        std::vector<std::pair<std::pair<bool, std::size_t>, AnswerGroup>> placed;
        for (AnswerGroup& group : result_.groups)
            placed.emplace_back(place(group), std::move(group));
        std::stable_sort(placed.begin(), placed.end(),
                         [](const auto& x, const auto& y) { return x.first < y.first; });
        result_.groups.clear();
        for (auto& [key, group] : placed)
            result_.groups.push_back(std::move(group));
    }

    // Conditions and techniques in the protocol's order, or else as they first come.
    void order() {
        const auto note = [](std::vector<std::string>& list, const std::string& name) {
            if (!name.empty() && std::find(list.begin(), list.end(), name) == list.end())
                list.push_back(name);
        };
        for (const auto& [folder, design] : study_.designs)
            if (design)
                for (const std::string& condition : design->order)
                    note(result_.conditions, condition);
        std::map<std::string, std::map<std::string, std::string>> shown;
        for (const AnsweredTrial& trial : study_.trials) {
            const std::string& id = trial.trial.row.conditionId;
            note(result_.conditions, id);
            for (std::size_t i = 0; i < trial.roles.size(); ++i)
                shown[id][trial.roles[i]] = trial.techniques[i];
            if (trial.design)
                if (const auto known = trial.design->conditions.find(id);
                    known != trial.design->conditions.end())
                    shown[id].insert(known->second.techniques.begin(),
                                     known->second.techniques.end());
        }
        for (const std::string& condition : result_.conditions)
            for (const auto& [role, technique] : shown[condition])
                note(result_.techniques, technique);
    }

    AnswerForm formOf(const AnsweredTrial& trial, const Given& given) const {
        const DesignFacts::Asked* asked = askedOf(trial, given);
        const std::string& kind = given.kind.text();
        if (kind == "rank")
            return AnswerForm::rank;
        if (kind == "scale" || kind == "slider") {
            const bool isSigned = asked ? asked->lowest < 0 : signed_.contains(given.question);
            return trial.roles.size() == 2 && isSigned ? AnswerForm::versus : AnswerForm::rating;
        }
        if (kind != "choice" || trial.roles.size() != 2 || (asked && !asked->images))
            return AnswerForm::none;
        if (!correctOf(trial).empty())
            return AnswerForm::ladder;
        const bool isPivot = !result_.pivot.empty() && !trial.techniqueOf(result_.pivot).empty();
        if (isPivot)
            return trial.design && !trial.design->boostReference.empty() ? AnswerForm::boosted
                                                                         : AnswerForm::plain;
        const std::set<std::string> ends(trial.roles.begin(), trial.roles.end());
        const bool hasMiddle = asked && std::find(asked->beside.begin(), asked->beside.end(),
                                                  "b") != asked->beside.end();
        if (ends == std::set<std::string>{"a", "c"} && hasMiddle)
            return AnswerForm::triad;
        return AnswerForm::comparison;
    }

    void sort(const AnsweredTrial& trial) {
        const Vote& row = trial.trial.row;
        const auto key = std::pair(row.studyId.number(), row.participantId.number());
        const int person = people_.try_emplace(key, static_cast<int>(people_.size())).first->second;
        for (const Given& given : trial.given) {
            const AnswerForm form = formOf(trial, given);
            if (form == AnswerForm::none) {
                if (unscaled_.insert(given.question).second)
                    result_.notes.push_back(fmt::format(
                        "The question \"{}\" ({}) has no scale: its answers are in sessions/ and "
                        "in the export.",
                        given.question, given.kind));
                continue;
            }
            for (const bool pooled : {false, true})
                if (!pooled || form != AnswerForm::ladder)
                    add(given.question, pooled ? "" : row.scene.text(),
                        pooled ? "" : row.level.text(), form, {&trial, &given, person});
        }
    }

    void add(const std::string& question, const std::string& scene, const std::string& level,
             AnswerForm form, const Observation& one) {
        auto group = std::find_if(
            result_.groups.begin(), result_.groups.end(), [&](const AnswerGroup& known) {
                return known.form == form && known.group.question == question &&
                       known.group.scene == scene && known.group.level == level;
            });
        if (group == result_.groups.end())
            group =
                result_.groups.insert(group, {ScaleGroup{question, scene, level, {}}, form, {}});
        group->members.push_back(one);
    }

    const TrialAnswers& study_;
    std::set<std::string> signed_, unscaled_; // questions
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> people_;
    AnswerGroups result_;
};

} // namespace

AnswerGroups answerGroups(const TrialAnswers& study) { return Sorter(study).result(); }

} // namespace obscura
