#include "analysis/scales/answer_groups.h"
#include "analysis/scales/ladders.h"
#include "analysis/scales/scale_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace obscura {

namespace {

// Counts what groups hold.
class Counter {
  public:
    Counter(AnswerGroups answers, const Manifest* stimuli)
        : answers_(std::move(answers)), stimuli_(stimuli) {}

    ScaleData data() {
        ScaleData data;
        for (const auto& [group, form, members] : answers_.groups) {
            if (form == AnswerForm::comparison)
                addPairLadders(data.ladders, counted(group, members), pairSteps(members), stimuli_,
                               "choices of b");
            if (form == AnswerForm::comparison || form == AnswerForm::boosted ||
                form == AnswerForm::plain)
                data.comparisons.push_back(comparisons(group, form, members));
            else if (form == AnswerForm::triad)
                data.triads.push_back(triads(group, members));
            else if (form == AnswerForm::ladder)
                data.ladders.push_back(ladder(group, members));
            else if (form == AnswerForm::rating || form == AnswerForm::versus)
                data.ratings.push_back(ratings(group, form, members));
            else if (form == AnswerForm::rank)
                data.rankings.push_back(rankings(group, members));
        }
        data.notes = answers_.notes;
        return data;
    }

  private:
    // What one role had, or without roles the condition itself.
    static std::string itemOf(const AnsweredTrial& trial) {
        if (trial.roles.empty())
            return trial.trial.row.conditionId;
        std::map<std::string, std::string> shown; // in the order of roles, not of places
        for (std::size_t i = 0; i < trial.roles.size(); ++i)
            shown[trial.roles[i]] = trial.techniques[i];
        std::string name;
        for (const auto& [role, technique] : shown)
            name += (name.empty() ? "" : " / ") + technique;
        return name;
    }

    // Items in the order of the protocol; people who answered, from 0.
    void fill(ScaleGroup& group, const std::vector<Observation>& members, bool together) {
        std::set<std::string> named;
        std::set<int> people;
        for (const Observation& one : members) {
            if (one.given->value == Symbol()) {
                ++group.open;
                continue;
            }
            ++group.answers;
            people.insert(one.person);
            if (together)
                named.insert(itemOf(*one.trial));
            else
                named.insert(one.trial->techniques.begin(), one.trial->techniques.end());
        }
        for (const std::string& technique : answers_.techniques)
            if (named.erase(technique))
                group.items.push_back(technique);
        group.items.insert(group.items.end(), named.begin(), named.end());
        group.people = static_cast<int>(people.size());
        number_.clear();
        for (const int person : people)
            number_.emplace(person, static_cast<int>(number_.size()));
        if (group.open > 0)
            group.notes.push_back(fmt::format("{} questions were left open", group.open));
    }

    static int indexOf(const ScaleGroup& group, const std::string& item) {
        return static_cast<int>(std::find(group.items.begin(), group.items.end(), item) -
                                group.items.begin());
    }

    Comparisons comparisons(const ScaleGroup& group, AnswerForm form,
                            const std::vector<Observation>& members) {
        Comparisons result{group};
        fill(result, members, false);
        result.isBoosted = form == AnswerForm::boosted;
        const auto n = static_cast<Eigen::Index>(result.items.size());
        const auto people = static_cast<std::size_t>(result.people);
        result.wins = result.ties = Eigen::MatrixXd::Zero(n, n);
        result.winsOf.assign(people, Wins::Zero(n, n));
        result.tiesOf.assign(people, Eigen::MatrixXd::Zero(n, n));
        for (const auto& [trial, given, person] : members) {
            if (given->value == Symbol())
                continue;
            if (form != AnswerForm::comparison)
                result.source = trial->techniqueOf(answers_.pivot);
            const int first = indexOf(result, trial->techniques[0]),
                      second = indexOf(result, trial->techniques[1]);
            const auto index = static_cast<std::size_t>(number_.at(person));
            if (given->value.text() == "unsure") {
                result.mayTie = true;
                result.tiesOf[index](first, second) += 1;
                result.tiesOf[index](second, first) += 1;
                continue;
            }
            const bool choseSecond = given->role.text() == trial->roles[1];
            ++result.placed;
            result.second += choseSecond;
            ++(choseSecond ? result.winsOf[index](second, first)
                           : result.winsOf[index](first, second));
        }
        for (std::size_t i = 0; i < people; ++i) {
            result.wins += result.winsOf[i];
            result.ties += result.tiesOf[i];
        }
        return result;
    }

    ScaleGroup counted(ScaleGroup group, const std::vector<Observation>& members) {
        fill(group, members, false);
        if (std::any_of(members.begin(), members.end(),
                        [](const Observation& one) { return one.given->value.text() == "unsure"; }))
            group.notes.push_back("\"not sure\" is half a choice");
        return group;
    }

    // Of each condition how often b was preferred to a.
    std::vector<Step> pairSteps(const std::vector<Observation>& members) const {
        std::map<std::string, Step> steps; // by condition
        for (const auto& [trial, given, person] : members) {
            if (given->value == Symbol())
                continue;
            const std::string& id = trial->trial.row.conditionId;
            Step& step = steps[id];
            if (step.trials == 0)
                step = {id,
                        fmt::format("{} > {}", trial->techniqueOf("b"), trial->techniqueOf("a")),
                        differencesOf(stimuli_, id, "a", "b")};
            ++step.trials;
            step.successes += given->value.text() == "unsure" ? 0.5
                              : given->role.text() == "b"     ? 1
                                                              : 0;
        }
        std::vector<Step> inOrder;
        for (const std::string& condition : answers_.conditions)
            if (const auto step = steps.find(condition); step != steps.end())
                inOrder.push_back(step->second);
        return inOrder;
    }

    Ratings ratings(const ScaleGroup& group, AnswerForm form,
                    const std::vector<Observation>& members) {
        Ratings result{group};
        result.isComparison = form == AnswerForm::versus;
        fill(result, members, !result.isComparison);
        for (const auto& [trial, given, person] : members) {
            if (given->value == Symbol())
                continue;
            if (const DesignFacts::Asked* asked = askedOf(*trial, *given);
                asked && given->kind.text() == "scale")
                result.range = {asked->lowest, asked->lowest + asked->options - 1};
            Ratings::Rating rating{number_.at(person), 0, -1, numberOf(*given)};
            if (result.isComparison) {
                rating.item = indexOf(result, trial->techniques[1]);
                rating.than = indexOf(result, trial->techniques[0]);
            } else {
                rating.item = indexOf(result, itemOf(*trial));
            }
            result.ratings.push_back(rating);
        }
        return result;
    }

    Rankings rankings(const ScaleGroup& group, const std::vector<Observation>& members) {
        Rankings result{group};
        fill(result, members, false);
        for (const auto& [trial, given, person] : members) {
            Ranking ranking;
            const std::string& roles = given->role.text(); // best first
            for (std::size_t begin = 0; begin < roles.size();) {
                const std::size_t end = std::min(roles.find('>', begin), roles.size());
                ranking.push_back(
                    indexOf(result, trial->techniqueOf(roles.substr(begin, end - begin))));
                begin = end + 1;
            }
            if (ranking.empty())
                continue;
            result.rankings.push_back(std::move(ranking));
            result.person.push_back(number_.at(person));
        }
        return result;
    }

    // Levels so that in every triad a comes before b, and b before c.
    static std::vector<std::string>
    levelsOf(const std::vector<std::string>& techniques,
             const std::set<std::pair<std::string, std::string>>& below, ScaleGroup& group) {
        std::vector<std::string> left = techniques, levels;
        while (!left.empty()) {
            auto next = std::find_if(left.begin(), left.end(), [&](const std::string& one) {
                return std::none_of(left.begin(), left.end(), [&](const std::string& other) {
                    return below.contains({other, one});
                });
            });
            if (next == left.end()) {
                group.notes.push_back("the triads contradict each other about the order of levels");
                next = left.begin();
            }
            levels.push_back(*next);
            left.erase(next);
        }
        return levels;
    }

    Triads triads(const ScaleGroup& group, const std::vector<Observation>& members) {
        Triads result{group};
        fill(result, members, false);
        std::set<std::string> shown(result.items.begin(), result.items.end());
        std::set<std::pair<std::string, std::string>> below;
        for (const auto& [trial, given, person] : members) {
            const std::string a = trial->techniqueOf("a"), b = trial->techniqueOf("b"),
                              c = trial->techniqueOf("c");
            shown.insert(b);
            below.insert({{a, b}, {b, c}});
        }
        std::vector<std::string> inOrder;
        for (const std::string& technique : answers_.techniques)
            if (shown.contains(technique))
                inOrder.push_back(technique);
        result.items = levelsOf(inOrder, below, result);
        for (const auto& [trial, given, person] : members) {
            if (given->value == Symbol() || given->value.text() == "unsure")
                continue;
            const int a = indexOf(result, trial->techniqueOf("a")),
                      b = indexOf(result, trial->techniqueOf("b")),
                      c = indexOf(result, trial->techniqueOf("c"));
            result.triads.push_back({a, b, b, c, given->role.text() == "c"});
            result.person.push_back(number_.at(person));
        }
        return result;
    }

    Ladder ladder(const ScaleGroup& group, const std::vector<Observation>& members) {
        Ladder result{group};
        fill(result, members, false);
        std::map<std::string, Step> steps;        // by condition
        std::map<std::string, std::string> right; // techniques
        std::set<std::string> wrong;
        int unsure = 0;
        for (const auto& [trial, given, person] : members) {
            if (given->value == Symbol())
                continue;
            if (given->value.text() == "unsure") {
                ++unsure;
                continue;
            }
            const std::string& id = trial->trial.row.conditionId;
            const std::string correct = correctOf(*trial);
            const std::string other = trial->roles[trial->roles[0] == correct ? 1 : 0];
            Step& step = steps[id];
            step.condition = id;
            step.label = trial->techniqueOf(other);
            wrong.insert(step.label);
            right[id] = trial->techniqueOf(correct);
            step.differences = differencesOf(stimuli_, id, other, correct);
            step.successes += given->role.text() == correct;
            ++step.trials;
            result.guess = 1.0 / static_cast<double>(trial->roles.size());
            result.isAdaptive = result.isAdaptive || trial->design->isAdaptive;
        }
        if (unsure > 0)
            result.notes.push_back(fmt::format(
                "{} answers \"not sure\" are neither right nor wrong: left out", unsure));
        result.success = "right answers";
        std::vector<Step> inOrder;
        for (const std::string& condition : answers_.conditions)
            if (const auto step = steps.find(condition); step != steps.end()) {
                inOrder.push_back(step->second);
                if (wrong.size() == 1) // it is the right one that changes from step to step
                    inOrder.back().label = right[condition];
            }
        setLevels(result, inOrder, stimuli_, orderlyMeasure(inOrder));
        return result;
    }

    const AnswerGroups answers_;
    const Manifest* stimuli_;
    std::map<int, int> number_; // of a person in the group that is being made
};

// Where there is one scene and level only, all together is the same again.
template <typename Kind>
void dropDoubles(std::vector<Kind>& groups) {
    std::map<std::pair<std::string, bool>, int> own; // of each question
    const auto key = [](const Kind& one) {
        if constexpr (std::is_same_v<Kind, Comparisons>)
            return std::pair(one.question, one.isBoosted);
        else if constexpr (std::is_same_v<Kind, Ladder>)
            return std::pair(one.question + one.axis, false);
        else
            return std::pair(one.question, false);
    };
    for (const Kind& one : groups)
        own[key(one)] += !one.isPooled();
    std::erase_if(groups, [&](const Kind& one) { return one.isPooled() && own[key(one)] == 1; });
}

} // namespace

ScaleData scaleData(const TrialAnswers& study, const Manifest* stimuli) {
    ScaleData data = Counter(answerGroups(study), stimuli).data();
    dropDoubles(data.comparisons);
    dropDoubles(data.ratings);
    dropDoubles(data.rankings);
    dropDoubles(data.triads);
    dropDoubles(data.ladders);
    return data;
}

} // namespace obscura
