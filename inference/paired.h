#pragma once

#include "inference/counts.h"
#include "inference/result.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace obscura {

// Do the conditions differ in their share of b? First for answers of the same people, which the
// tests need to know person by person; then for totals, which treat the votes as independent.

// The same people in two conditions. Of which neither is b, or both are, does not matter.
struct PairedVotes {
    std::int64_t both = 0;       // b in both conditions
    std::int64_t firstOnly = 0;  // b in the first condition only
    std::int64_t secondOnly = 0; // b in the second condition only
    std::int64_t neither = 0;
};

// McNemar, Psychometrika 12 (1947) 153, on the people who changed. `corrected` is
// (|b - c| - 1)^2 / (b + c) of Edwards, Psychometrika 13 (1948) 185, to the letter: for b = c it
// is 1 / (b + c), where R's mcnemar.test has 0. The exact and mid-p tests are those of b : c votes
// (exactP, midP). Without anybody who changed all p are 1 and there is no statistic.
struct McNemar {
    std::int64_t firstOnly = 0, secondOnly = 0;
    Test uncorrected, corrected;
    double exactP = 1, midP = 1;
};
McNemar mcnemar(PairedVotes votes);

// The smallest and largest exactP that McNemar's test could have had, were it known who answered
// what, where only the totals are published: `first` and `second` of `people` chose b. It is
// largest when as few as possible chose b twice. Totals outside of 0 ... people are an Error.
Interval mcnemarBounds(std::int64_t people, std::int64_t first, std::int64_t second);

// Answers of people (rows) in k conditions (columns): 1 is b, 0 is a. Every row is complete:
// people who did not answer all conditions must be left out, and said. Rows of different lengths
// and other numbers are an Error.
using AnswerTable = std::vector<std::vector<int>>;

// How many chose b in each condition.
std::vector<double> columnTotals(const AnswerTable& answers);

// Cochran, Biometrika 37 (1950) 256: Q = (k - 1)(k sum C^2 - (sum C)^2) / (k sum R - sum R^2) with
// column totals C and row totals R, at k - 1 degrees of freedom. Absent when nobody changed his
// answer. At k = 2 it is McNemar's.
std::optional<Test> cochranQ(const AnswerTable& answers);

// Trend of the same people's answers over k scores (levels, or the error of a picture): chi-square
// at 1 degree of freedom of T = sum x_j C_j, given everybody's number of b; the score test of a
// conditional logistic regression (R's survival::clogit), Mantel, J. Am. Stat. Assoc. 58 (1963)
// 690. Absent when nobody changed his answer, or all scores are equal. At k = 2 it is McNemar's.
// As many scores as columns, or it is an Error.
std::optional<Test> pairedTrend(const AnswerTable& answers, std::span<const double> scores);

// For totals, one element for each condition: too small an error if people answer alike, too
// large if the same people answer differently. Conditions without votes are left out.
// Pearson's chi-square of k x 2 counts, without correction (R's chisq.test(correct = FALSE)).
// Absent with fewer than two conditions, or where all chose a, or all b.
std::optional<Test> homogeneity(std::span<const Votes> conditions);

// Cochran and Armitage: Armitage, Biometrics 11 (1955) 375 (R's prop.trend.test). Absent as above,
// or when all scores of conditions with votes are equal.
std::optional<Test> trend(std::span<const Votes> conditions, std::span<const double> scores);

// The association of two answers within strata, such as that of b being shown second with b being
// chosen, within conditions. Counts {{shown second and b, shown second and a}, {first and b, ...}}.
using FourfoldTable = std::pair<Votes, Votes>;

// Mantel and Haenszel, J. Natl. Cancer Inst. 22 (1959) 719, without correction (R's
// mantelhaen.test(correct = FALSE)), and the common odds ratio (b in the first row) as a logarithm
// with the standard error of Robins, Breslow, Greenland, Biometrics 42 (1986) 311.
struct MantelHaenszel {
    Test test;
    std::optional<Estimate> logOddsRatio; // absent where it is infinite
};
// Absent where no stratum varies in both.
std::optional<MantelHaenszel> mantelHaenszel(std::span<const FourfoldTable> strata);

// One number for each person, such as his share of second images, against `centre`.
// Student's t (R's t.test(mu)). Absent for fewer than two people, or where all are the same.
std::optional<Test> tTest(std::span<const double> values, double centre);
// The mean and its interval that excludes the centre where tTest rejects it (R's t.test);
// 0 < confidence < 1. Absent where that is, for the centre 0 of values that are not all the same.
std::optional<Interval> tInterval(std::span<const double> values, double confidence = 0.95);
// The same, and where all are alike, for which there is no t, the sign test (without a statistic):
// always a test, of at least one value.
Test centreTest(std::span<const double> values, double centre);
// Wilcoxon's signed ranks: the normal approximation with corrections for ties and continuity (R's
// wilcox.test(mu, exact = FALSE)); differences of 0 are left out. The statistic is V, the sum of
// the ranks above. Absent where nobody differs from the centre.
std::optional<Test> signedRankTest(std::span<const double> values, double centre);

} // namespace obscura
