#pragma once

#include <cstdint>

namespace obscura {

// Tails of distributions, each computed by itself and never as one minus the other: against R
// 4.2.2 they agree to 1e-12 relative down to 1e-300 (pbinom, pchisq, pt, pnorm, with log.p).
// What is smaller than the smallest double (2e-308) becomes 0.

// P(X <= k) and P(X >= k) for X ~ Bin(trials, probability): incomplete beta functions, whose time
// does not grow with the trials. k may lie outside of 0 ... trials.
double binomialLower(std::int64_t k, std::int64_t trials, double probability);
double binomialUpper(std::int64_t k, std::int64_t trials, double probability);
double binomialMass(std::int64_t k, std::int64_t trials, double probability); // 0 <= k <= trials

// P(X >= statistic) of chi-square; df > 0, also broken ones (Kendall's u); statistic >= 0.
double chiSquareP(double statistic, double df = 1);

// P(|T| >= |statistic|) of Student's t, and of the normal distribution; df > 0.
double studentP(double statistic, double df);
double normalP(double statistic);

// P(F >= statistic) of Fisher's F; both df > 0; statistic >= 0.
double fisherFP(double statistic, double df, double denominatorDf);

double studentQuantile(double probability, double df); // 0 < probability < 1
double probit(double probability);                     // the normal quantile; 0 < probability < 1

} // namespace obscura
