#pragma once

#include "inference/counts.h"

#include <cstdint>
#include <optional>

namespace obscura {

// How many people a study needs, exactly: sums of binomial probabilities, no simulation. `share`
// is the true share of b (0 to 1), `level` the test's (0 < level < 1).

// The p of a two-sided test of votes against 1/2, the same for (a, b) and (b, a), and no larger
// for more uneven votes: exactP, midP, or that of chiSquare.
using PofVotes = double (*)(Votes);

// The probability that the test gives p <= level among n people, n >= 1. At share 1/2 it is the
// true size of the test.
double power(PofVotes test, std::int64_t n, double share, double level = 0.05);

// The probability that equivalenceP is below the level among n people; n >= 1.
double equivalencePower(std::int64_t n, double margin, double share = 0.5, double level = 0.05);

// The smallest n from which on the power never falls below the target again: exact power is a
// saw-tooth in n. 1/2 <= target < 1. Absent when more than 2^20 people (a million) are needed, or
// when no number is enough (share 1/2; a share outside of 1/2 -+ margin).
std::optional<std::int64_t> sampleSize(PofVotes test, double share, double target = 0.8,
                                       double level = 0.05);
std::optional<std::int64_t> equivalenceSampleSize(double margin, double share = 0.5,
                                                  double target = 0.8, double level = 0.05);

// What the normal approximation gives for the test of 1/2, always too few:
// ((z(1 - level / 2) / 2 + z(target) sqrt(share (1 - share))) / (share - 1/2))^2 (Fleiss, Levin,
// Paik, Statistical Methods for Rates and Proportions, 3rd ed. 2003, section 2.5). Absent at 1/2.
std::optional<double> approximateSampleSize(double share, double target = 0.8, double level = 0.05);

} // namespace obscura
