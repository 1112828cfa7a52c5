#include "analysis/study_tests.h"

#include "inference/agreement.h"
#include "inference/mixed.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>

namespace obscura {

namespace {

std::uint64_t personOf(const Vote& row) {
    return std::uint64_t{row.studyId.number()} << 32 | row.participantId.number();
}

// Conditions, by their place among the tallies, that compare the same two techniques at several
// levels and have votes: all of them and, where other scenes are among them, those of one scene,
// which differ in nothing but the level.
using Group = std::vector<std::size_t>;

std::vector<Group> groupsOf(const std::vector<Tally>& tallies) {
    std::map<std::pair<std::string, std::string>, std::map<std::string, Group>> pairs; // by scene
    for (std::size_t i = 0; i < tallies.size(); ++i)
        if (tallies[i].votes.total() > 0)
            for (const std::string& scene : {std::string(), tallies[i].scene})
                pairs[{tallies[i].techniqueA, tallies[i].techniqueB}][scene].push_back(i);
    std::vector<Group> several;
    for (const auto& [pair, scenes] : pairs)
        for (const auto& [scene, group] : scenes) {
            std::set<std::string> levels;
            for (const std::size_t member : group)
                levels.insert(tallies[member].level);
            const bool again = !scene.empty() && group == scenes.begin()->second;
            if (levels.size() >= 2 && !again)
                several.push_back(group);
        }
    return several;
}

std::string namesOf(const StudyData& data, const Group& group) {
    const Tally& first = data.tallies[group.front()];
    std::string names;
    for (const std::size_t member : group)
        names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", data.tallies[member].level,
                             data.tallies[member].scene);
    return fmt::format("{} over {}: {}", first.techniqueB, first.techniqueA, names);
}

// Where every level has a scene of its own, nobody can say which of the two makes a difference.
std::string confounding(const StudyData& data, const Group& group) {
    std::map<std::string, std::set<std::string>> levels; // by scene
    for (const std::size_t member : group)
        levels[data.tallies[member].scene].insert(data.tallies[member].level);
    const bool crossed = std::any_of(levels.begin(), levels.end(),
                                     [](const auto& scene) { return scene.second.size() >= 2; });
    if (!crossed)
        return "level and scene change together: which of them matters cannot be told";
    return levels.size() > 1 ? "scenes differ, too" : "";
}

std::string joined(const std::vector<std::string>& notes) {
    std::string text;
    for (const std::string& note : notes)
        if (!note.empty())
            text += (text.empty() ? "" : "; ") + note;
    return text;
}

// The answers of those people who answered all conditions of the group.
AnswerTable completeOf(const StudyData& data, const Group& group) {
    AnswerTable table;
    for (const std::vector<int>& person : data.people) {
        std::vector<int> row;
        for (const std::size_t member : group)
            if (person[member] >= 0)
                row.push_back(person[member]);
        if (row.size() == group.size())
            table.push_back(std::move(row));
    }
    return table;
}

std::string leftOut(const StudyData& data, const AnswerTable& complete) {
    const std::size_t missing = data.people.size() - complete.size();
    return missing == 0
               ? ""
               : fmt::format("{} people who did not answer all of them are left out", missing);
}

std::vector<StudyTest> cochran(const StudyData& data) {
    std::vector<StudyTest> tests;
    for (const Group& group : groupsOf(data.tallies)) {
        if (!data.answers || group.size() < 3)
            continue;
        const AnswerTable complete = completeOf(data, group);
        tests.push_back({namesOf(data, group), complete.empty() ? std::nullopt : cochranQ(complete),
                         joined({confounding(data, group), leftOut(data, complete)})});
    }
    return tests;
}

std::vector<StudyTest> mcNemar(const StudyData& data) {
    std::vector<StudyTest> tests;
    for (const Group& group : groupsOf(data.tallies)) {
        if (!data.answers || group.size() != 2)
            continue;
        PairedVotes votes;
        const AnswerTable complete = completeOf(data, group);
        for (const std::vector<int>& row : complete)
            ++(row[0] ? (row[1] ? votes.both : votes.firstOnly)
                      : (row[1] ? votes.secondOnly : votes.neither));
        const McNemar result = mcnemar(votes);
        tests.push_back({namesOf(data, group), Test{std::nullopt, std::nullopt, result.exactP},
                         joined({fmt::format("{} and {} people changed their answer",
                                             result.firstOnly, result.secondOnly),
                                 confounding(data, group), leftOut(data, complete)})});
    }
    return tests;
}

// Of totals: all that can be said where nobody knows who answered what.
std::vector<StudyTest> totals(const StudyData& data) {
    std::vector<StudyTest> tests;
    for (const Group& group : groupsOf(data.tallies)) {
        if (data.answers)
            continue;
        std::vector<Votes> votes;
        for (const std::size_t member : group)
            votes.push_back(data.tallies[member].votes);
        std::string bounds;
        if (votes.size() == 2 && votes[0].total() == votes[1].total()) {
            const Interval p = mcnemarBounds(votes[0].total(), votes[0].b, votes[1].b);
            bounds = fmt::format("McNemar's exact p could be anything from {:.4f} to {:.4f}", p.low,
                                 p.high);
        }
        tests.push_back({namesOf(data, group), homogeneity(votes),
                         joined({"takes the votes for those of different people, which they are "
                                 "not: only trial by trial can decide",
                                 bounds, confounding(data, group)})});
    }
    return tests;
}

std::vector<StudyTest> pooledPosition(const StudyData& data) {
    if (!data.answers)
        return {};
    Votes votes;
    for (const Answer& answer : *data.answers)
        ++(answer.row.choseSecond() ? votes.b : votes.a);
    return {{fmt::format("{} of {} votes are for the second picture", votes.b, votes.total()),
             Test{std::nullopt, std::nullopt, exactP(votes)},
             "takes every vote for another person's"}};
}

std::vector<StudyTest> positionByPerson(const StudyData& data) {
    if (!data.answers)
        return {};
    std::unordered_map<std::uint64_t, Votes> votes;
    for (const Answer& answer : *data.answers) {
        Votes& person = votes[personOf(answer.row)];
        ++(answer.row.choseSecond() ? person.b : person.a);
    }
    std::vector<double> shares;
    double sum = 0;
    for (const auto& [person, v] : votes) {
        shares.push_back(static_cast<double>(v.b) / static_cast<double>(v.total()));
        sum += shares.back();
    }
    std::sort(shares.begin(), shares.end()); // the order of a hash table is nobody's
    return {{fmt::format("{:.1f} % of a person's votes on average, {} people",
                         100 * sum / static_cast<double>(shares.size()), shares.size()),
             tTest(shares, 0.5), ""}};
}

std::vector<StudyTest> positionWithinConditions(const StudyData& data) {
    if (!data.answers)
        return {};
    std::unordered_map<std::uint32_t, FourfoldTable> strata;
    for (const Answer& answer : *data.answers) {
        FourfoldTable& stratum = strata[answer.row.conditionId.number()];
        Votes& votes = answer.row.aFirst ? stratum.first : stratum.second;
        ++(answer.row.choseB ? votes.b : votes.a);
    }
    std::map<std::uint32_t, FourfoldTable> ordered(strata.begin(), strata.end());
    std::vector<FourfoldTable> tables;
    for (const auto& [condition, table] : ordered)
        tables.push_back(table);
    const auto result = mantelHaenszel(tables);
    const bool odds = result && result->logOddsRatio;
    return {{odds ? fmt::format("the odds of b are {:.2f} times as high when it is second",
                                std::exp(result->logOddsRatio->value))
                  : "the odds of b when it is second",
             result ? std::optional(result->test) : std::nullopt, ""}};
}

std::vector<StudyTest> camps(const StudyData& data) {
    Group all;
    for (std::size_t i = 0; i < data.tallies.size(); ++i)
        if (data.tallies[i].votes.total() > 0)
            all.push_back(i);
    const AnswerTable complete = completeOf(data, all);
    const auto ratio = data.answers && complete.size() > 1 && all.size() > 1
                           ? betweenPersonVarianceRatio(complete)
                           : std::nullopt;
    if (!ratio)
        return {};
    return {{fmt::format("people's numbers of b vary {:.2f} times as much as chance", ratio->ratio),
             ratio->test, leftOut(data, complete)}};
}

constexpr std::size_t mostRows = 200000; // for a model that is fitted at once

// Position and all conditions together, each person with a tendency of their own.
BinomialData modelOf(const StudyData& data, std::vector<int>& person, bool conditions) {
    std::unordered_map<std::string, Eigen::Index> columns;
    for (const Tally& tally : data.tallies)
        if (tally.votes.total() > 0)
            columns.try_emplace(tally.condition, static_cast<Eigen::Index>(columns.size()));
    const auto rows = static_cast<Eigen::Index>(data.answers->size());
    const Eigen::Index last = conditions ? static_cast<Eigen::Index>(columns.size()) : 1;
    BinomialData model{Eigen::MatrixXd::Zero(rows, last + 1), Eigen::VectorXd(rows),
                       Eigen::VectorXd::Ones(rows)};
    std::unordered_map<std::uint64_t, int> people;
    person.clear();
    for (Eigen::Index i = 0; i < rows; ++i) {
        const Vote& row = (*data.answers)[static_cast<std::size_t>(i)].row;
        model.design(i, conditions ? columns.at(row.conditionId) : 0) = 1;
        model.design(i, last) = row.aFirst ? 0.5 : -0.5;
        model.successes(i) = row.choseB;
        person.push_back(
            people.try_emplace(personOf(row), static_cast<int>(people.size())).first->second);
    }
    return model;
}

std::vector<StudyTest> mixed(const StudyData& data) {
    const auto conditions = std::count_if(data.tallies.begin(), data.tallies.end(),
                                          [](const Tally& t) { return t.votes.total() > 0; });
    if (!data.answers || conditions < 2)
        return {};
    if (data.answers->size() > mostRows)
        return {{"all conditions", std::nullopt,
                 fmt::format("not fitted to more than {} votes", mostRows)}};
    const bool bothOrders =
        std::any_of(data.answers->begin(), data.answers->end(), [&](const Answer& answer) {
            return answer.row.aFirst != data.answers->front().row.aFirst;
        });
    if (!bothOrders)
        return {{"all conditions", std::nullopt, "b was always in the same place"}};
    std::vector<int> person;
    const BinomialData all = modelOf(data, person, true), same = modelOf(data, person, false);
    const MixedFit full = fitMixed(all, person), equal = fitMixed(same, person);
    const std::string people = fmt::format("between people: sd {:.2f} (logit)", full.sd);
    std::vector<StudyTest> tests = {
        {"do the conditions differ in the share of b? (likelihood ratio)",
         likelihoodRatio(equal.logLikelihood, full.logLikelihood, static_cast<int>(conditions) - 1),
         people}};
    const Eigen::Index last = full.coefficients.size() - 1;
    if (full.converged && !full.separated) {
        const double beta = full.coefficients(last), error = std::sqrt(full.covariance(last, last));
        tests.push_back(
            {fmt::format("position: b second multiplies its odds by {:.2f} (Wald)", std::exp(beta)),
             Test{beta / error, std::nullopt, normalP(beta / error)}, people});
    }
    return tests;
}

const TestKind kinds[] = {
    {"cochran", "Does the preference depend on complexity, among the same people?",
     "Cochran's Q, 1950", cochran},
    {"mcnemar", "Does the preference depend on complexity, among the same people?",
     "McNemar 1947, exact", mcNemar},
    {"homogeneity", "Does the preference depend on complexity? (totals only)",
     "Pearson's chi-square 1900", totals},
    {"position", "Is the second picture chosen more or less often?", "binomial test",
     pooledPosition},
    {"position-people", "The same, by person", "Student's t, 1908", positionByPerson},
    {"position-conditions", "The same, within conditions", "Mantel and Haenszel 1959",
     positionWithinConditions},
    {"people", "Do people differ more than chance?", "Cochran's Q of people", camps},
    {"mixed", "All at once, each person with a tendency of their own",
     "mixed logistic regression (adaptive quadrature, 15 points)", mixed},
};

} // namespace

StudyData studyData(std::vector<Tally> tallies, const std::vector<Answer>* answers) {
    StudyData data{std::move(tallies), answers, {}};
    if (!answers)
        return data;
    std::unordered_map<std::uint32_t, std::size_t> conditions;
    for (std::size_t i = 0; i < data.tallies.size(); ++i)
        conditions[Symbol(data.tallies[i].condition).number()] = i;
    std::unordered_map<std::uint64_t, std::size_t> people;
    for (const Answer& answer : *answers) {
        const std::size_t person =
            people.try_emplace(personOf(answer.row), people.size()).first->second;
        if (person == data.people.size())
            data.people.emplace_back(data.tallies.size(), -1);
        int& first = data.people[person][conditions.at(answer.row.conditionId.number())];
        if (first < 0)
            first = answer.row.choseB;
    }
    return data;
}

std::span<const TestKind> testKinds() { return kinds; }

} // namespace obscura
