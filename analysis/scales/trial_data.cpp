#include "analysis/scales/ladders.h"
#include "analysis/scales/scale_data.h"
#include "base/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>

namespace obscura {

namespace {

// What an answer says, which decides what is made of it.
enum class Form { comparison, boosted, plain, triad, ladder, rating, versus, rank, none };

struct Observation {
    const AnsweredTrial* trial;
    const Given* given;
    int person;
};

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

// The study's answers, sorted.
class Sorter {
  public:
    Sorter(const TrialAnswers& study, const Manifest* stimuli) : study_(study), stimuli_(stimuli) {
        for (const auto& [folder, design] : study.designs)
            if (design && !design->boostReference.empty())
                pivot_ = design->boostReference;
        order();
        for (const AnsweredTrial& trial : study.trials)
            for (const Given& given : trial.given)
                if (given.value != Symbol() && askedOf(trial, given) == nullptr &&
                    (given.kind.text() == "scale" || given.kind.text() == "slider") &&
                    numberOf(given) < 0)
                    signed_.insert(given.question);
        for (const AnsweredTrial& trial : study.trials)
            sort(trial);
        const auto place = [&](const Group& group) { // of its first condition in the protocol
            std::size_t first = conditions_.size();
            for (const Observation& one : group.members)
                first = std::min(first, static_cast<std::size_t>(
                                            std::find(conditions_.begin(), conditions_.end(),
                                                      one.trial->trial.row.conditionId.text()) -
                                            conditions_.begin()));
            return std::pair(group.group.isPooled(), first);
        };
        std::vector<std::pair<std::pair<bool, std::size_t>, Group>> placed;
        for (Group& group : groups_)
            placed.emplace_back(place(group), std::move(group));
        std::stable_sort(placed.begin(), placed.end(),
                         [](const auto& x, const auto& y) { return x.first < y.first; });
        groups_.clear();
        for (auto& [key, group] : placed)
            groups_.push_back(std::move(group));
    }

    ScaleData data() {
        ScaleData data;
        for (const auto& [group, form, members] : groups_) {
            if (form == Form::comparison || form == Form::boosted || form == Form::plain)
                data.comparisons.push_back(comparisons(group, form, members));
            else if (form == Form::triad)
                data.triads.push_back(triads(group, members));
            else if (form == Form::ladder)
                data.ladders.push_back(ladder(group, members));
            else if (form == Form::rating || form == Form::versus)
                data.ratings.push_back(ratings(group, form, members));
            else if (form == Form::rank)
                data.rankings.push_back(rankings(group, members));
        }
        data.notes = notes_;
        return data;
    }

  private:
    struct Group {
        ScaleGroup group;
        Form form;
        std::vector<Observation> members;
    };

    // Conditions and techniques in the protocol's order, or else as they first come.
    void order() {
        const auto note = [](std::vector<std::string>& list, const std::string& name) {
            if (!name.empty() && std::find(list.begin(), list.end(), name) == list.end())
                list.push_back(name);
        };
        for (const auto& [folder, design] : study_.designs)
            if (design)
                for (const std::string& condition : design->order)
                    note(conditions_, condition);
        std::map<std::string, std::map<std::string, std::string>> shown;
        for (const AnsweredTrial& trial : study_.trials) {
            const std::string& id = trial.trial.row.conditionId;
            note(conditions_, id);
            for (std::size_t i = 0; i < trial.roles.size(); ++i)
                shown[id][trial.roles[i]] = trial.techniques[i];
            if (trial.design)
                if (const auto known = trial.design->conditions.find(id);
                    known != trial.design->conditions.end())
                    shown[id].insert(known->second.techniques.begin(),
                                     known->second.techniques.end());
        }
        for (const std::string& condition : conditions_)
            for (const auto& [role, technique] : shown[condition])
                note(techniques_, technique);
    }

    Form formOf(const AnsweredTrial& trial, const Given& given) const {
        const DesignFacts::Asked* asked = askedOf(trial, given);
        const std::string& kind = given.kind.text();
        if (kind == "rank")
            return Form::rank;
        if (kind == "scale" || kind == "slider") {
            const bool isSigned = asked ? asked->lowest < 0 : signed_.contains(given.question);
            return trial.roles.size() == 2 && isSigned ? Form::versus : Form::rating;
        }
        if (kind != "choice" || trial.roles.size() != 2 || (asked && !asked->images))
            return Form::none;
        if (!correctOf(trial).empty())
            return Form::ladder;
        const bool isPivot = !pivot_.empty() && !trial.techniqueOf(pivot_).empty();
        if (isPivot)
            return trial.design && !trial.design->boostReference.empty() ? Form::boosted
                                                                         : Form::plain;
        const std::set<std::string> ends(trial.roles.begin(), trial.roles.end());
        const bool hasMiddle = asked && std::find(asked->beside.begin(), asked->beside.end(),
                                                  "b") != asked->beside.end();
        if (ends == std::set<std::string>{"a", "c"} && hasMiddle)
            return Form::triad;
        return Form::comparison;
    }

    void sort(const AnsweredTrial& trial) {
        const Vote& row = trial.trial.row;
        const auto key = std::pair(row.studyId.number(), row.participantId.number());
        const int person = people_.try_emplace(key, static_cast<int>(people_.size())).first->second;
        for (const Given& given : trial.given) {
            const Form form = formOf(trial, given);
            if (form == Form::none) {
                if (unscaled_.insert(given.question).second)
                    notes_.push_back(fmt::format(
                        "The question \"{}\" ({}) has no scale: its answers are in sessions/ and "
                        "in the export.",
                        given.question, given.kind));
                continue;
            }
            for (const bool pooled : {false, true})
                if (!pooled || form != Form::ladder)
                    add(given.question, pooled ? "" : row.scene.text(),
                        pooled ? "" : row.level.text(), form, {&trial, &given, person});
        }
    }

    void add(const std::string& question, const std::string& scene, const std::string& level,
             Form form, const Observation& one) {
        auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& known) {
            return known.form == form && known.group.question == question &&
                   known.group.scene == scene && known.group.level == level;
        });
        if (group == groups_.end())
            group = groups_.insert(group, {ScaleGroup{question, scene, level, {}}, form, {}});
        group->members.push_back(one);
    }

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
        for (const std::string& technique : techniques_)
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

    Comparisons comparisons(const ScaleGroup& group, Form form,
                            const std::vector<Observation>& members) {
        Comparisons result{group};
        fill(result, members, false);
        result.isBoosted = form == Form::boosted;
        const auto n = static_cast<Eigen::Index>(result.items.size());
        const auto people = static_cast<std::size_t>(result.people);
        result.wins = result.ties = Eigen::MatrixXd::Zero(n, n);
        result.winsOf.assign(people, Wins::Zero(n, n));
        result.tiesOf.assign(people, Eigen::MatrixXd::Zero(n, n));
        for (const auto& [trial, given, person] : members) {
            if (given->value == Symbol())
                continue;
            if (form != Form::comparison)
                result.source = trial->techniqueOf(pivot_);
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

    Ratings ratings(const ScaleGroup& group, Form form, const std::vector<Observation>& members) {
        Ratings result{group};
        result.isComparison = form == Form::versus;
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
        for (const std::string& technique : techniques_)
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
            step.difference = stimulusDifference(stimuli_, id, other, correct);
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
        for (const std::string& condition : conditions_)
            if (const auto step = steps.find(condition); step != steps.end()) {
                inOrder.push_back(step->second);
                if (wrong.size() == 1) // it is the right one that changes from step to step
                    inOrder.back().label = right[condition];
            }
        setLevels(result, inOrder, true);
        return result;
    }

    const TrialAnswers& study_;
    const Manifest* stimuli_;
    std::string pivot_; // the role from which images differ, in triplets
    std::vector<std::string> conditions_, techniques_;
    std::set<std::string> signed_, unscaled_; // questions
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> people_;
    std::map<int, int> number_; // of a person in the group that is being made
    std::vector<Group> groups_;
    std::vector<std::string> notes_;
};

// Where there is one scene and level only, all together is the same again.
template <typename Kind>
void dropDoubles(std::vector<Kind>& groups) {
    std::map<std::pair<std::string, bool>, int> own; // of each question
    const auto key = [](const Kind& one) {
        if constexpr (std::is_same_v<Kind, Comparisons>)
            return std::pair(one.question, one.isBoosted);
        else
            return std::pair(one.question, false);
    };
    for (const Kind& one : groups)
        own[key(one)] += !one.isPooled();
    std::erase_if(groups, [&](const Kind& one) { return one.isPooled() && own[key(one)] == 1; });
}

} // namespace

ScaleData scaleData(const TrialAnswers& study, const Manifest* stimuli) {
    ScaleData data = Sorter(study, stimuli).data();
    dropDoubles(data.comparisons);
    dropDoubles(data.ratings);
    dropDoubles(data.rankings);
    dropDoubles(data.triads);
    return data;
}

} // namespace obscura
