#include "analysis/study_tests.h"

#include "analysis/tests/tests.h"

#include <cstdint>
#include <unordered_map>

namespace obscura {

namespace {

const TestKind kinds[] = {
    {"cochran", "Does the preference depend on complexity, among the same people?",
     "Cochran's Q, 1950", cochranTests, true},
    {"mcnemar", "Does the preference depend on complexity, among the same people?",
     "McNemar 1947, exact", mcNemarTests, true},
    {"trend", "Does it rise or fall with complexity, among the same people?",
     "Mantel 1963, conditional trend", levelTrendTests, true},
    {"homogeneity", "Does the preference depend on complexity? (totals only)",
     "Pearson's chi-square 1900", homogeneityTests, true},
    {"trend-totals", "Does it rise or fall with complexity? (totals only)",
     "Cochran and Armitage 1955", totalsTrendTests, true},
    {"position", "Is the second picture chosen more or less often?", "binomial test",
     pooledPositionTests},
    {"position-people", "The same, by person", "Student's t, 1908", personPositionTests},
    {"position-conditions", "The same, within conditions", "Mantel and Haenszel 1959",
     conditionPositionTests},
    {"people", "Do people differ more than chance?", "Cochran's Q of people", varianceTests},
    {"repeats", "Do people agree with themselves, more than guessing would?",
     "pairs of repeats against one half", repeatTests},
    {"repeats-conditions", "Of which conditions are people of an opinion, even if they split?",
     "pairs of repeats against one half", conditionRepeatTests, true},
    {"logistic", "All at once, as if every vote were another person's", "logistic regression",
     logisticTests},
    {"gee", "All at once, averages over people", "GEE, exchangeable, robust (Liang and Zeger 1986)",
     geeTests},
    {"mixed", "All at once, each person with a tendency of their own",
     "mixed logistic regression (adaptive quadrature, 15 points)", mixedTests},
};

} // namespace

StudyData studyData(std::vector<Tally> tallies, const std::vector<Answer>* answers) {
    StudyData data{std::move(tallies), answers, {}, false};
    if (!answers)
        return data;
    std::unordered_map<std::uint32_t, std::size_t> conditions;
    for (std::size_t i = 0; i < data.tallies.size(); ++i)
        conditions[Symbol(data.tallies[i].condition).number()] = i;
    std::unordered_map<std::uint64_t, std::size_t> people;
    for (const Answer& answer : *answers) {
        const std::size_t person =
            people.try_emplace(answer.row.person(), people.size()).first->second;
        if (person == data.people.size())
            data.people.emplace_back(data.tallies.size(), -1);
        int& first = data.people[person][conditions.at(answer.row.conditionId.number())];
        data.repeats = data.repeats || first >= 0;
        if (first < 0)
            first = answer.row.choseB;
    }
    return data;
}

std::span<const TestKind> testKinds() { return kinds; }

} // namespace obscura
