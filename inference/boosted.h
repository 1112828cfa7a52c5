#pragma once

#include "inference/scales.h"

#include <optional>

namespace obscura {

// Triplets with the source as pivot ("which of i and j differs more from it?") shown plain and
// boosted (enlarged, amplified, flickering), as in JPEG AIC-3 (ISO/IEC 29170-3; Men, Lin,
// Jenadeleh, Saupe, IEEE Access 9 (2021) 138939; Testolina et al., arXiv:2410.09501). Boosting
// tells small differences apart and stretches the scale; plain triplets say by how much.
//
// One likelihood for both: with x the boosted scale, P(i differs more) = Phi((x(i) - x(j))
// probit(0.75)), and plain answers see y = linear x + quadratic x^2 in its place. Values are y, so
// that 1 JND is 75 % of plain answers; the source lies at 0. The published method names a unified
// model of both; that the map is this polynomial is our choice.
struct BoostedScale {
    Scale scale;             // relative to the source: values (y) and covariance
    Eigen::VectorXd boosted; // x, in boosted JND
    Estimate linear, quadratic;
    bool isMonotone = false; // y rises with x over all x: else do not trust it
};

// wins(i, j): i was said to differ more from the source than j ("not sure" as half a vote each).
// Both matrices name the same items; `source` is one of them. Absent where the boosted scale is
// (thurstone()), or the plain votes do not tell the polynomial.
std::optional<BoostedScale> boostedScale(const Wins& boosted, const Wins& plain, int source);

} // namespace obscura
