#pragma once

#include "inference/counts.h"
#include "inference/paired.h"
#include "inference/result.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace obscura {

// Do people agree with themselves, and with each other? Tables whose rows have different lengths
// are an Error.

// One person compared each of t items with each other once; `wins` are the choices of each item.
// Circular triads are "x over y, y over z, z over x": Kendall and Babington Smith, Biometrika 31
// (1940) 324: t (t - 1)(2t - 1) / 12 - sum wins^2 / 2. zeta = 1 - triads / most is 1 for a
// person without contradiction. Absent unless t >= 3 and the wins sum to t (t - 1) / 2.
struct CircularTriads {
    std::int64_t triads = 0, most = 0;
    double zeta = 1; // 0 ... 1
};
std::optional<CircularTriads> circularTriads(std::span<const std::int64_t> wins);

// Kendall and Babington Smith's coefficient of agreement between m people who each compared all
// pairs of t items: wins[i][j] is how many preferred i to j; the diagonal does not count.
// u = 8 sum C(wins, 2) / (m (m - 1) t (t - 1)) - 1: 1 if all agree, -1 / (m - 1) (m even) or -1 / m
// (m odd) if they split. Chi-square with their broken degrees of freedom; its test is absent for
// m < 3. Absent altogether for m < 2, t < 2, or pairs with different numbers of answers.
struct PairAgreement {
    double u = 0;
    std::optional<Test> test;
};
std::optional<PairAgreement> kendallU(const std::vector<std::vector<std::int64_t>>& wins);

// m people (rows) ranked or scored k items (columns), in any unit and direction that they share:
// Kendall and Babington Smith, Ann. Math. Stat. 10 (1939) 275, W with ties corrected (1 if all
// rank alike, 0 if not at all), and the test of Friedman, J. Am. Stat. Assoc. 32 (1937) 675,
// m (k - 1) W at k - 1 degrees of freedom (R's friedman.test). Absent without people, for k < 2, or
// where everybody ties everything. A score that is not finite is an Error.
struct Concordance {
    double w = 0;
    Test friedman;
};
std::optional<Concordance> concordance(const std::vector<std::vector<double>>& scores);

// How differently people choose b over the conditions (columns): the variance of their number of
// b, as a multiple of the one under independence, sum p (1 - p) of the conditions' shares p. Above
// 1 where camps differ throughout, below 1 where people balance their answers. The test is for
// more than chance: Cochran's Q with people and conditions exchanged. Absent for fewer than two
// people, or where in every condition all answered alike.
struct VarianceRatio {
    double ratio = 1;
    Test test;
};
std::optional<VarianceRatio> betweenPersonVarianceRatio(const AnswerTable& answers);

// Repeats of one question by one person are a cell; all pairs of answers within cells as votes: a
// disagree, b agree. Who guesses agrees in half of them, on any condition; who is of an opinion
// agrees in more, although half of the people may be of the other one. Under guessing pairs are
// uncorrelated, so chiSquare tests this at any number of repeats, and exactP where each cell has
// two. (homogeneity() of the cells of one condition tests whether people differ.)
Votes repeatAgreement(std::span<const Votes> cells);

} // namespace obscura
