#pragma once

#include "inference/glm.h"

#include <optional>
#include <span>

namespace obscura {

struct GeeFit {
    Eigen::VectorXd coefficients; // averages over people, unlike fitMixed's
    Eigen::MatrixXd covariance;   // robust: right even if the correlations are not as assumed
    // The same for few people, for whom it is too small: Mancl and DeRouen, Biometrics 57 (2001)
    // 126. Absent where a coefficient rests on one person alone, or nothing else can be told.
    std::optional<Eigen::MatrixXd> corrected{};
    double correlation = 0; // between two answers of one person
    double scale = 1;       // of the variance
    // False: no correlation solves the equations (few or extreme answers); the fit is then the one
    // that assumes none, fitGlm's, whose robust covariance allows for it nevertheless.
    bool converged = false;
    bool separated = false; // as in GlmFit; nothing else can then be told
};

// Binomial regression of single choices whose answers correlate equally within a person:
// generalised estimating equations, Liang and Zeger, Biometrika 73 (1986) 13, with scale and
// correlation by moments of the Pearson residuals, without small-sample factors. Equals R's
// geepack::geeglm(..., id = factor(person), corstr = "exchangeable") 1.3.9. `person` numbers each
// row's person from 0. Error as fitGlm, or if a row has other than one trial, or there is but one
// person. With few people test with `corrected`, by t and F of people - coefficients degrees of
// freedom.
GeeFit fitGee(const BinomialData& data, std::span<const int> person, Link link = Link::logit);

} // namespace obscura
