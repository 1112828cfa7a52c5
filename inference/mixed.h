#pragma once

#include "inference/glm.h"

#include <optional>
#include <vector>

namespace obscura {

// A binomial regression in which each person has a tendency of their own: the linear predictor of
// person i's rows is design x coefficients + offset + b_i, b_i normal with mean 0 and standard
// deviation `sd`. Coefficients are for a given person, not averages over people.
struct MixedOptions {
    Link link = Link::logit;
    int points = 15; // of adaptive quadrature; 1 is Laplace's approximation
};

struct MixedFit {
    Eigen::VectorXd coefficients;
    Eigen::MatrixXd covariance;      // from the second derivative by coefficients and sd together
    double sd = 0;                   // between people, in units of the linear predictor; >= 0
    std::optional<double> sdError{}; // absent where sd = 0 or the maximum is not finite
    double logLikelihood = 0;        // with the binomial coefficients
    Eigen::VectorXd persons;         // each person's most likely b
    bool converged = false;
    // People do not differ more than chance: the best sd is 0 and the fit is fitGlm's.
    bool boundary = false;
    // As in GlmFit, or sd grows without bound (beyond 100): the estimate is infinite.
    bool separated = false;
    // No sd can be told: there is one person, or nobody has two trials. The fit is fitGlm's.
    bool identified = true;
    int evaluations = 0;
};

// Maximum likelihood; equals R's lme4::glmer(..., nAGQ = points) 1.1-31, whose scale of the
// quadrature (expected information at the mode) it shares, so that Laplace's approximation agrees
// for probit too. lme4 stops at 1e-5 or so; here the gradient is exact and zero to 1e-7 standard
// errors. `person` numbers each row's person from 0; equal rows of a person are fitted as one, so
// 100,000 rows of 14 kinds cost what 14 rows a person do. Where the likelihood has several hills
// (few people whose sd is large; Laplace's approximation of it, which is then poor) the one found
// is near sd = 1, as lme4's. Every number is finite in every case. Error as fitGlm, or when
// `person` does not fit.
MixedFit fitMixed(const BinomialData& data, std::span<const int> person,
                  const MixedOptions& options = {});

} // namespace obscura
