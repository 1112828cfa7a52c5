#pragma once

#include "inference/scales.h"

#include <optional>
#include <span>
#include <vector>

namespace obscura {

// What pwcmp computes (Perez-Ortiz and Mantiuk, arXiv:1712.03686; github.com/mantiuk/pwcmp, MIT),
// so that its numbers can be compared. One JOD is 1 / 1.4826 standard deviations there.

// Thurstone's case V in JOD, sum 0, by pw_scale's objective; shared golden/human has the formula.
// Prior none is maximum likelihood, absent as thurstone() is. The Gaussian prior makes a distance
// likelier that other pairs' shares also speak for; it pulls unanimous pairs to finite distances.
// Its values are absent where groups were never compared, and where even so they grow without end
// (a single comparison). It gives no standard errors: take them from bootstrap.h. Its time grows
// with the fifth power of the items: seven take a millisecond, fifty some ten seconds.
std::optional<Eigen::VectorXd> pwcmpScale(const Wins& wins);
std::optional<Eigen::VectorXd> pwcmpScaleWithPrior(const Wins& wins);

// How far each observer's answers lie from those of all others: the log likelihood of his wins
// under the scale (Gaussian prior) of the others, summed over scenes, and by how many interquartile
// ranges it lies below the lower quartile of all observers; 0 above it. pwcmp calls 1.5 and more
// an outlier to look at, not to delete unseen. `scenes` holds a list of wins for each scene, one
// for each observer in the same order.
struct Outlyingness {
    double logLikelihood = 0, distance = 0;
};
std::optional<std::vector<Outlyingness>> outlyingness(std::span<const std::vector<Wins>> scenes);

} // namespace obscura
