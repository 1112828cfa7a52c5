#pragma once

#include "inference/scales.h"

#include <span>
#include <utility>
#include <vector>

namespace obscura {

// Which pairs to compare next, so that answers say most: after ASAP (Mikhailiuk, Wilmot,
// Perez-Ortiz, Yue, Mantiuk, "Active Sampling for Pairwise Comparisons via Approximate Message
// Passing and Information Gain Maximization", arXiv:2004.05691). As there, a batch is the spanning
// tree of the greatest gains, so that all items remain connected and one batch can be shown in any
// order. Departures: the posterior is Laplace's and not by message passing, and the gain is that of
// the exact posterior and not of its Gaussian approximation.

// Standard deviation of the prior of each item's value, in JOD: that of scales of some ten JOD.
inline constexpr double pairPriorSd = 3;

// Of Thurstone's case V in JOD, with a normal prior around 0: the mode and the covariance of the
// normal curve there. It exists whatever was compared, nothing included. Throws as thurstone().
struct PairPosterior {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
};
PairPosterior pairPosterior(const Wins& wins, double priorSd = pairPriorSd);

// By how much an answer is expected to change the posterior: the Kullback-Leibler divergence from
// before to after, in nats, over both answers; at most log 2. Items differ.
double expectedGain(const PairPosterior& posterior, int item, int other);

using ItemPair = std::pair<int, int>;

// A spanning tree of the greatest expected gain, of each of the scales that the pairs connect:
// indices of `pairs`, the greatest gain first, of equal gains that listed first. Its size is always
// the number of items that the pairs name, less that of the scales: n - 1 for one.
std::vector<int> nextBatch(const PairPosterior& posterior, std::span<const ItemPair> pairs);

// The widest of the intervals of all items, each of its distance from the mean of the items of its
// scale, in JOD.
double widestInterval(const PairPosterior& posterior, std::span<const ItemPair> pairs,
                      double confidence = 0.95);

} // namespace obscura
