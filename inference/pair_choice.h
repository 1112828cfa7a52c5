#pragma once

#include "inference/scales.h"

#include <span>
#include <utility>
#include <vector>

namespace obscura {

// Which pairs to compare next, so that answers narrow the scales most: after ASAP (Mikhailiuk,
// Wilmot, Perez-Ortiz, Yue, Mantiuk, "Active Sampling for Pairwise Comparisons via Approximate
// Message Passing and Information Gain Maximization", arXiv:2004.05691), with its batches of n - 1
// and all answers in each posterior. Departures, of which docs/measurement.md has the effect: what
// is to fall is the mean variance of values, which is Bayesian A-optimality (Chaloner, Verdinelli,
// Statistical Science 10 (1995) 273), and not the entropy; a batch is built pair by pair and need
// not be a tree; the posterior is Laplace's and not by message passing.

// Standard deviation of the prior of each item's value, in JOD: that of scales of some ten JOD.
inline constexpr double pairPriorSd = 3;

// Of Thurstone's case V in JOD, with a normal prior around 0: the mode and the covariance of the
// normal curve there. It exists whatever was compared, nothing included. Throws as thurstone().
struct PairPosterior {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
};
PairPosterior pairPosterior(const Wins& wins, double priorSd = pairPriorSd);

// By how much an answer is expected to lessen the sum of the variances of all items, in JOD^2, were
// the posterior the normal curve. Items differ.
double expectedReduction(const PairPosterior& posterior, int item, int other);

using ItemPair = std::pair<int, int>;

// Indices of `pairs`, each once: the pair of the greatest expected reduction, then that of the
// greatest once the covariance is what the first is expected to leave, and so on; of equals the one
// listed first. As many as a spanning tree has of each of the scales that the pairs connect: the
// number of items that the pairs name, less that of the scales; n - 1 for one.
std::vector<int> nextBatch(PairPosterior posterior, std::span<const ItemPair> pairs);

// The widest of the intervals of all items, each of its distance from the mean of the items of its
// scale, in JOD.
double widestInterval(const PairPosterior& posterior, std::span<const ItemPair> pairs,
                      double confidence = 0.95);

} // namespace obscura
