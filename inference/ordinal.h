#pragma once

#include "inference/link.h"
#include "inference/ordinal_data.h"
#include <Eigen/Core>

#include <optional>
#include <span>

namespace obscura {

struct OrdinalFit {
    Eigen::VectorXd thresholds; // ascending, one fewer than categories
    Eigen::VectorXd coefficients;
    Eigen::MatrixXd covariance; // thresholds, then coefficients; from the observed information
    double logLikelihood = 0;
    bool converged = false; // otherwise a coefficient is infinite (separated) and only the
                            // likelihood says something
};

// Maximum likelihood; equals R's ordinal::clm 2022.11-16. Error when sizes disagree, a category
// between 0 and the highest is not used, there is one category only, or a column depends on others
// (the thresholds stand for an intercept).
OrdinalFit fitOrdinal(const OrdinalData& data, Link link = Link::logit);

struct OrdinalMixedFit : OrdinalFit {
    double sd = 0; // between people, in units of the linear predictor
    std::optional<double> sdError{};
    bool boundary = false;  // the best sd is 0: the fit is fitOrdinal's
    bool separated = false; // sd grows without bound (beyond 100)
    bool identified = true; // false: one person, or nobody has two ratings; fitOrdinal's fit
};

// The same with a normal random intercept for each person, added to design x coefficients; adaptive
// quadrature with `points` (1: Laplace). Equals ordinal::clmm(..., nAGQ = points).
OrdinalMixedFit fitOrdinalMixed(const OrdinalData& data, std::span<const int> person,
                                Link link = Link::logit, int points = 15);

} // namespace obscura
