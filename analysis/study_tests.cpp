#include "analysis/study_tests.h"

#include "analysis/tests/tests.h"

#include "inference/multiplicity.h"

#include <map>
#include <utility>

namespace obscura {

namespace {

const TestKind testKindRows[] = {
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
    {"gee", "All at once, averages over people",
     "GEE, exchangeable (Liang and Zeger 1986), robust for few people (Mancl and DeRouen 2001)",
     geeTests},
    {"mixed", "All at once, each person with a tendency of their own",
     "mixed logistic regression (adaptive quadrature, 15 points)", mixedTests},
};

// The tests of one question over several groups of conditions are a family.
void correctGroups(std::vector<Tested>& tests) {
    std::map<std::string_view, std::vector<Tested*>> families;
    for (Tested& one : tests)
        if (one.kind->groups && one.result.test)
            families[one.kind->question].push_back(&one);
    for (const auto& [question, family] : families) {
        std::vector<double> p;
        for (const Tested* one : family)
            p.push_back(one->result.test->p);
        const std::vector<double> adjusted = holm(p);
        for (std::size_t i = 0; i < family.size() && family.size() > 1; ++i)
            family[i]->holm = adjusted[i];
    }
}

} // namespace

std::span<const TestKind> testKinds() { return testKindRows; }

std::vector<Tested> testsOf(const StudyData& data) {
    std::vector<Tested> tests;
    for (const TestKind& kind : testKinds())
        for (StudyTest& result : kind.run(data))
            tests.push_back({&kind, std::move(result)});
    correctGroups(tests);
    return tests;
}

} // namespace obscura
