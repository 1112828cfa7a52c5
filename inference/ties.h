#pragma once

#include "inference/link.h"
#include "inference/scales.h"
#include <Eigen/Core>

#include <optional>

namespace obscura {

// Scales from paired comparisons that may end in a tie ("the same", "not sure"). ties(i, j) counts
// those of a pair: symmetric, the size of wins, diagonal 0; Error otherwise.
struct TieScale {
    Scale scale;
    // How readily people tie, in the model's own measure; absent when nobody tied: it is 0 then,
    // at the edge of what is possible, without a standard error.
    std::optional<Estimate> ties;
};

// Davidson, J. Am. Stat. Assoc. 65 (1970) 317: with worths w, P(i) : P(j) : P(tie) =
// w(i) : w(j) : nu sqrt(w(i) w(j)). Values are log worths, ties is nu (>= 0): two equal items tie
// with probability nu / (2 + nu). Agrees with R's psychotools 0.7-2, btmodel(undecided = TRUE).
// Absent where the likelihood has no finite maximum: only ties, or an item that never lost.
std::optional<TieScale> davidson(const Wins& wins, const Eigen::MatrixXd& ties);

// A threshold on the difference: P(i) = F(q(i) - q(j) - t), P(j) = F(q(j) - q(i) - t), and a tie
// between. Logistic: Rao and Kupper, J. Am. Stat. Assoc. 62 (1967) 194, values log worths, ties is
// t = log theta. Normal: Glenn and David, Biometrics 16 (1960) 86, that is Thurstone's case V, all
// in JOD: q(i) - q(j) = 1 and t = 0 is 75 %. Agrees with R's ordinal 2022.11.16,
// clm(threshold = "symmetric2"). Absent as davidson() is.
std::optional<TieScale> thresholdScale(const Wins& wins, const Eigen::MatrixXd& ties, Link link);

} // namespace obscura
