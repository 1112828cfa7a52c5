#pragma once

#include "inference/result.h"
#include "inference/scales.h"

#include <optional>
#include <span>
#include <vector>

namespace obscura {

// One answer of a paired comparison; observers and items number from 0.
struct Choice {
    int observer = 0;
    int first = 0, second = 0; // items in the order shown
    bool choseFirst = false;
};

// A Bayesian Bradley-Terry model with the observers in it, in the manner of BBQ (Aczel, Theis,
// Wattenhofer, arXiv:2510.09333, 2025: each rater has a quality, estimated with the items, so that
// the unreliable count less). The parts of that quality, and how it is fitted, are ours:
//
//   P(first) = lapse / 2 + (1 - lapse) logistic(precision (value(first) - value(second)) + bias)
//
// bias in logits (> 0: towards the first), lapse 0 to 1, precision > 0 with 1 the typical observer.
// Normal priors with the means and standard deviations below, on value, bias, log precision and
// logit lapse; all but the last have mean 0. The result is the posterior mode with Laplace's
// covariance. Unlike leaving observers out, nobody is deleted: who guesses weighs little. The
// priors let a guesser lapse rather than be imprecise, for precisions set the unit of the scale,
// and guessers taken for very imprecise people would shrink it for all. In few answers low
// precision and lapses look alike: precision (1 - lapse) is told better than either.
struct ObserverPriors {
    double valueSd = 3, biasSd = 0.7, logPrecisionSd = 0.35; // all > 0
    double logitLapseMean = -3.5, logitLapseSd = 2;          // median 3 %, 95 % below 45 %
};

struct ObserverTraits {
    Estimate bias, lapse, precision; // errors of lapse and precision by the delta method
};

struct ObserverModel {
    Scale scale; // log worths for an observer without bias and lapses, with precision 1
    std::vector<ObserverTraits> observers;
    double logPosterior = 0; // up to a constant
};

// Items that were never compared, not even through others, have no common scale: absent. Observers
// without answers get their priors back. `items` >= 2, `observers` >= 1; Error for choices of
// others.
std::optional<ObserverModel> observerModel(int items, int observers,
                                           std::span<const Choice> choices,
                                           const ObserverPriors& priors = {});

} // namespace obscura
