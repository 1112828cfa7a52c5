#pragma once

#include "inference/link.h"
#include "inference/result.h"
#include <Eigen/Core>

#include <span>

namespace obscura {

// Binomial regression: `successes` of `trials` in each row have the probability F(design x
// coefficients + offset), F the link's distribution. Rows may be single choices (trials 1) or
// tallies; both give the same coefficients. Rows without trials count for nothing.
struct BinomialData {
    Eigen::MatrixXd design;    // rows x coefficients, of full column rank
    Eigen::VectorXd successes; // 0 ... trials
    Eigen::VectorXd trials;    // >= 0; may be fractions (weights)
    Eigen::VectorXd offset{};  // added to the linear predictor; empty: 0
};

struct GlmOptions {
    Link link = Link::logit;
    // Inverse covariance of a Gaussian prior of mean 0 on the coefficients, coefficients x
    // coefficients; empty: none. With it the fit is the posterior mode, the covariance that of the
    // normal curve through it, and any design and any data have a finite fit.
    Eigen::MatrixXd priorPrecision{};
};

// When the data are separated (some direction of the coefficients predicts every row on one side
// perfectly, Albert and Anderson, Biometrika 71 (1984) 1), the estimate is infinite: then
// `separated` is set, the coefficients are those where the climb ended and say only the sign, and
// the covariance says nothing. Log-likelihood and deviance are right to 1e-8 even then (they are
// suprema), so likelihood-ratio tests may use them. Every number is finite in every case.
struct GlmFit {
    Eigen::VectorXd coefficients;
    Eigen::MatrixXd covariance; // inverse of the expected information (plus prior precision)
    double logLikelihood = 0;   // with the binomial coefficients, without the prior (R's logLik)
    double deviance = 0;        // against one parameter per row, so it depends on the grouping
    bool converged = false;     // a finite maximum was reached
    bool separated = false;
    int iterations = 0;
};

// Maximum likelihood by iteratively reweighted least squares with step halving; equals R's
// glm(cbind(successes, failures) ~ 0 + design, binomial(link)). Error when sizes disagree, a value
// is not finite or out of range, or a column of the design depends on the others (and no prior).
GlmFit fitGlm(const BinomialData& data, const GlmOptions& options = {});

// Covariance of the coefficients that stays right when the rows of a cluster (a person) depend on
// each other: Liang and Zeger, Biometrika 73 (1986) 13, without small-sample factors; equals R's
// sandwich::vcovCL(fit, cluster, type = "HC0", cadjust = FALSE). `cluster` numbers each row's
// cluster from 0.
Eigen::MatrixXd clusterCovariance(const BinomialData& data, const GlmFit& fit, Link link,
                                  std::span<const int> cluster);

// Likelihood-ratio test of a model against one with `df` fewer parameters, both fitted to the same
// rows: twice the difference of the log-likelihoods, chi-square with df degrees of freedom (Wilks,
// Ann. Math. Stat. 9 (1938) 60); R's anova(smaller, larger, test = "Chisq"). df >= 1. Not for the
// test that an sd is 0, which lies on the border of its range.
Test likelihoodRatio(double smaller, double larger, int df);

// Checks that sizes agree and values are finite and in range; Error otherwise. What every model of
// this room begins with.
void check(const BinomialData& data);

// Error naming the first column that depends on the others, if one does.
void requireFullRank(const Eigen::MatrixXd& design);

// Inverse of a symmetric matrix, or its pseudo-inverse where rounding leaves it none, so that the
// (meaningless) covariance of separated data is finite.
Eigen::MatrixXd symmetricInverse(const Eigen::MatrixXd& matrix);

// The log binomial coefficients of all rows, which likelihoods of tallies include; 0 for rows of
// one trial.
double logBinomialCoefficients(const BinomialData& data);

} // namespace obscura
