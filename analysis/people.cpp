#include "analysis/people.h"

#include "analysis/findings.h"
#include "base/percentile.h"

#include "inference/agreement.h"
#include "inference/multiplicity.h"
#include "inference/person_rows.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <unordered_map>

namespace obscura {

namespace {

using Rows = std::span<const Eigen::Index>; // of one person, among the answers

constexpr std::size_t mostModelled = 100'000; // answers of the observers' model
constexpr double mostWork = 1e8;              // people times squared conditions

// Each answer's person, from 0 in the order of first answers.
std::vector<int> numbered(const std::vector<Answer>& answers) {
    std::unordered_map<std::uint64_t, int> numbers;
    std::vector<int> persons;
    persons.reserve(answers.size());
    for (const Answer& answer : answers)
        persons.push_back(numbers.try_emplace(answer.row.person(), static_cast<int>(numbers.size()))
                              .first->second);
    return persons;
}

template <auto field>
double medianOf(const std::vector<Answer>& answers, Rows rows) {
    std::vector<double> values;
    for (const Eigen::Index row : rows)
        values.push_back(answers[static_cast<std::size_t>(row)].row.*field);
    return percentile(std::move(values), 0.5);
}

// Pairs of answers to one condition.
Votes repeatsOf(const std::vector<Answer>& answers, Rows rows) {
    std::vector<std::pair<std::uint32_t, bool>> chosen;
    for (const Eigen::Index row : rows) {
        const Vote& vote = answers[static_cast<std::size_t>(row)].row;
        chosen.emplace_back(vote.conditionId.number(), vote.choseB);
    }
    std::sort(chosen.begin(), chosen.end());
    std::vector<Votes> cells;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (i == 0 || chosen[i].first != chosen[i - 1].first)
            cells.emplace_back();
        ++(chosen[i].second ? cells.back().b : cells.back().a);
    }
    return repeatAgreement(cells);
}

int sessionsOf(const std::vector<Answer>& answers, Rows rows) {
    std::set<std::uint32_t> sessions;
    for (const Eigen::Index row : rows)
        sessions.insert(answers[static_cast<std::size_t>(row)].row.sessionId.number());
    return static_cast<int>(sessions.size());
}

Person personOf(const std::vector<Answer>& answers, Rows rows, const std::vector<bool>& flagged) {
    const Vote& any = answers[static_cast<std::size_t>(rows.front())].row;
    Person person;
    person.study = any.studyId;
    person.participant = any.participantId;
    person.sessions = sessionsOf(answers, rows);
    for (const Eigen::Index row : rows) {
        const auto at = static_cast<std::size_t>(row);
        ++(answers[at].row.choseSecond() ? person.places.b : person.places.a);
        person.flaggedTimes += flagged[at];
    }
    person.p = exactP(person.places);
    person.repeats = repeatsOf(answers, rows);
    person.view1Ms = medianOf<&Vote::view1Ms>(answers, rows);
    person.view2Ms = medianOf<&Vote::view2Ms>(answers, rows);
    person.decisionMs = medianOf<&Vote::decisionRtMs>(answers, rows);
    return person;
}

// All conditions as one scale: item 0 stands for the a of each, so that every condition has a
// distance of its own and all of them tell of the same observers.
std::vector<Choice> choicesOf(const std::vector<Answer>& answers, const std::vector<Tally>& tallies,
                              const std::vector<int>& person) {
    std::unordered_map<std::uint32_t, int> items;
    for (std::size_t i = 0; i < tallies.size(); ++i)
        items[Symbol(tallies[i].condition).number()] = static_cast<int>(i) + 1;
    std::vector<Choice> choices;
    choices.reserve(answers.size());
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const Vote& row = answers[i].row;
        const int b = items.at(row.conditionId.number());
        choices.push_back({person[i], row.aFirst ? 0 : b, row.aFirst ? b : 0, !row.choseSecond()});
    }
    return choices;
}

EstimatedShare shareOf(const ObserverModel& model, Eigen::Index item) {
    const double distance = model.scale.values(item) - model.scale.values(0);
    const Eigen::MatrixXd& c = model.scale.covariance;
    const double reach = probit(0.975) * std::sqrt(c(item, item) + c(0, 0) - 2 * c(item, 0));
    const auto share = [](double logit) { return 1 / (1 + std::exp(-logit)); };
    return {share(distance),
            {share(distance - reach), share(distance + reach)},
            normalP(distance / reach * probit(0.975))};
}

void addObservers(const std::vector<Answer>& answers, const std::vector<Tally>& tallies,
                  const std::vector<int>& person, People& people) {
    const auto conditions = static_cast<double>(tallies.size());
    if (answers.size() > mostModelled ||
        static_cast<double>(people.persons.size()) * conditions * conditions > mostWork)
        return;
    // Conditions without votes would belong to no scale.
    std::vector<Tally> voted;
    for (const Tally& tally : tallies)
        if (tally.votes.total() > 0)
            voted.push_back(tally);
    const auto model =
        observerModel(static_cast<int>(voted.size()) + 1, static_cast<int>(people.persons.size()),
                      choicesOf(answers, voted, person));
    if (!model)
        return;
    for (std::size_t i = 0; i < people.persons.size(); ++i)
        people.persons[i].observer = model->observers[i];
    Eigen::Index item = 0;
    for (const Tally& tally : tallies)
        people.observers.push_back(tally.votes.total() > 0 ? std::optional(shareOf(*model, ++item))
                                                           : std::nullopt);
}

// -- Words --

// Of each condition with votes, whether its p, adjusted for its family, is a difference.
template <typename POf>
std::vector<bool> differences(const std::vector<Tally>& tallies, const POf& pOf) {
    std::map<std::string, std::pair<std::vector<std::size_t>, std::vector<double>>> families;
    for (std::size_t i = 0; i < tallies.size(); ++i)
        if (tallies[i].votes.total() > 0) {
            auto& [members, p] = families[tallies[i].family];
            members.push_back(i);
            p.push_back(pOf(i));
        }
    std::vector<bool> differs(tallies.size());
    for (const auto& [family, both] : families) {
        const std::vector<double> adjustedP = holm(both.second);
        for (std::size_t k = 0; k < adjustedP.size(); ++k)
            differs[both.first[k]] = adjustedP[k] < significance;
    }
    return differs;
}

// Where another estimate of the shares contradicts a verdict: by it a condition differs from an
// even split though the verdict has no difference, or the other way round. So that this is no
// matter of the kind of test, it must contradict the votes by chi-square, too, and move the share
// by half a percent at least. A condition whose estimate is absent keeps its votes.
std::string contradictions(const std::vector<Tally>& tallies,
                           const std::vector<std::optional<EstimatedShare>>& other) {
    const auto chi = [&](std::size_t i) { return chiSquareP(chiSquare(tallies[i].votes)); };
    const std::vector<bool> raw = differences(tallies, chi);
    const std::vector<bool> now =
        differences(tallies, [&](std::size_t i) { return other[i] ? other[i]->p : chi(i); });
    const auto verdicts = verdictsOf(tallies);
    std::string text;
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        const Tally& tally = tallies[i];
        if (!verdicts[i] || !other[i] || verdicts[i]->outcome == Verdict::Outcome::unusable)
            continue;
        const auto [a, b] = tally.votes;
        const double share = static_cast<double>(b) / static_cast<double>(a + b);
        if (now[i] != raw[i] && now[i] != verdicts[i]->differs() &&
            std::abs(share - other[i]->share) >= 0.005)
            text += fmt::format("{}{} ({}, {}) {:.0f} % instead of {:.0f} %, which would {}differ "
                                "from an even split",
                                text.empty() ? "" : "; ", tally.condition, tally.scene, tally.level,
                                100 * other[i]->share, 100 * share, now[i] ? "" : "not ");
    }
    return text;
}

std::string pText(double p) { return p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", p); }

const Tested* testOf(const Findings& findings, std::string_view id) {
    const auto found = std::find_if(findings.tests.begin(), findings.tests.end(),
                                    [&](const Tested& one) { return one.kind->id == id; });
    return found == findings.tests.end() || !found->result.test ? nullptr : &*found;
}

// By person; positionExplains() speaks of all votes.
std::string leaning(const Findings& findings) {
    const Tested* test = testOf(findings, "position-people");
    if (!test || test->result.test->p >= significance)
        return {};
    return fmt::format("CAUTION: people lean to one place. The second picture was chosen in {} (t "
                       "test by person, {}). The shares for balanced orders allow for that.",
                       test->result.about, pText(test->result.test->p));
}

std::string onePlace(const People& people) {
    const auto biased = std::count_if(people.persons.begin(), people.persons.end(),
                                      [](const Person& one) { return one.holm < significance; });
    if (biased == 0)
        return {};
    return fmt::format("CAUTION: {} of {} people chose one place more often than chance, whatever "
                       "stood there (exact p < .05 after Holm); people.csv names them. Their votes "
                       "count, but say little about the pictures.",
                       biased, people.persons.size());
}

std::string adjusted(const Findings& findings) {
    std::vector<std::optional<EstimatedShare>> shares;
    for (const Tally& tally : findings.tallies)
        shares.push_back(tally.people ? std::nullopt // its votes depend on each other
                                      : balancedShare(tally.bFirst, tally.bSecond));
    const std::string list = contradictions(findings.tallies, shares);
    return list.empty() ? ""
                        : fmt::format("CAUTION: the order changes results. Were b first and second "
                                      "equally often, its share would be: {}.",
                                      list);
}

// Even splits are guessing or camps: as far as that can be told.
std::string camps(const Findings& findings) {
    std::string text;
    for (const char* id : {"people", "repeats"})
        if (const Tested* test = testOf(findings, id))
            text += fmt::format("{}{} ({}): {}.", text.empty() ? "Guessing or camps: " : " ",
                                test->result.about, pText(test->result.test->p), test->result.note);
    return text;
}

std::string flaggedTimes(const Findings& findings) {
    const ResponseTimes& times = findings.people->times;
    const std::int64_t count = times.count();
    if (count == 0)
        return {};
    std::string changes;
    for (const ResponseTimes::Change& change : times.changes)
        changes += fmt::format("{}{} is {} and would be {}", changes.empty() ? "" : "; ",
                               findings.tallies[change.tally].condition, nameOf(change.with),
                               nameOf(change.without));
    return fmt::format("{} of {} decision times are unusual (logarithms more than 2.5 MAD from the "
                       "median); their votes count. Without them {}.",
                       count, times.isFlagged.size(),
                       changes.empty() ? "every verdict would be the same" : changes);
}

std::string observersOf(const Findings& findings) {
    const auto& observers = findings.people->observers;
    if (observers.empty() || findings.people->persons.size() < 2)
        return {};
    const Tested* camps = testOf(findings, "people");
    const char* unsuited = camps && camps->result.test->p < significance
                               ? " That model knows no camps: it takes the smaller for guessing."
                               : "";
    const std::string list = contradictions(findings.tallies, observers);
    return (list.empty() ? "With people's bias, lapses and reliability in the model, every "
                           "difference stays, and there is no new one."
                         : fmt::format("With people's bias, lapses and reliability in the model, a "
                                       "typical observer's share of b is: {}.",
                                       list)) +
           std::string(unsuited);
}

std::vector<std::string> spoken(const std::vector<std::string>& sentences) {
    std::vector<std::string> some;
    for (const std::string& sentence : sentences)
        if (!sentence.empty())
            some.push_back(sentence);
    return some;
}

} // namespace

std::vector<std::string> flagsOf(const Person& person) {
    std::vector<std::string> flags;
    if (person.holm < significance)
        flags.emplace_back("position");
    if (person.repeats.total() >= 5 && person.repeats.b <= person.repeats.a)
        flags.emplace_back("repeats");
    if (person.flaggedTimes > 0 && 5 * person.flaggedTimes >= person.trials())
        flags.emplace_back("times");
    return flags;
}

People peopleOf(const std::vector<Answer>& answers, const std::vector<Tally>& tallies) {
    People people;
    people.times = responseTimes(answers, tallies);
    const std::vector<int> person = numbered(answers);
    const PersonOrder order = orderByPerson(person, static_cast<Eigen::Index>(answers.size()));
    std::vector<double> p;
    for (std::size_t i = 0; i + 1 < order.first.size(); ++i) {
        const Rows rows =
            Rows(order.rows)
                .subspan(static_cast<std::size_t>(order.first[i]),
                         static_cast<std::size_t>(order.first[i + 1] - order.first[i]));
        people.persons.push_back(personOf(answers, rows, people.times.isFlagged));
        p.push_back(people.persons.back().p);
    }
    const std::vector<double> adjustedP = holm(p);
    for (std::size_t i = 0; i < adjustedP.size(); ++i)
        people.persons[i].holm = adjustedP[i];
    addObservers(answers, tallies, person, people);
    return people;
}

std::vector<std::string> peopleCautions(const Findings& findings) {
    if (!findings.people)
        return {};
    return spoken({leaning(findings), onePlace(*findings.people), adjusted(findings)});
}

std::vector<std::string> peopleSentences(const Findings& findings) {
    if (!findings.people)
        return {};
    return spoken({camps(findings), observersOf(findings), flaggedTimes(findings)});
}

} // namespace obscura
