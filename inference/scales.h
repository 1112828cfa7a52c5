#pragma once

#include "inference/jod.h"
#include "inference/result.h"
#include <Eigen/Core>

#include <optional>
#include <vector>

namespace obscura {

// Scales from paired comparisons of n >= 2 items. wins(i, j) says how often i was preferred to j:
// an n x n matrix of finite numbers >= 0 with a diagonal of 0; a vote may be split (0.5 each).
// Everything here throws Error for any other matrix. Votes count as independent: where people vote
// more than once, intervals by bootstrap.h are the honest ones.
using Wins = Eigen::MatrixXd;

// Which scale the comparisons can give. Items of different groups were never compared, not even
// through others, so that no method can place one group against the other. Items of a tier beat
// each other, directly or in a circle; tiers are ordered so that no item ever lost to one of a
// later tier of its group. Maximum likelihood is finite if and only if there is one tier (Ford,
// Am. Math. Monthly 64 (1957) 28).
struct Connection {
    std::vector<std::vector<int>> groups, tiers; // items ascending
};
Connection connection(const Wins& wins);

// A scale has no zero of its own: values sum to 0, and only differences mean anything. The
// covariance (rank n - 1) serves any of them.
struct Scale {
    Eigen::VectorXd values;
    Eigen::MatrixXd covariance;
    double logLikelihood = 0; // without the binomial coefficients
    double deviance = 0;      // -2 log likelihood ratio to a free share for each pair
    int freedom = 0;          // of the deviance: pairs compared - (n - 1)
    double nullDeviance = 0;  // the same when all items are equal
};

// P(i preferred to j) = 1 / (1 + exp(values(j) - values(i))): Bradley and Terry, Biometrika 39
// (1952) 324. Values are log worths. Agrees with R's BradleyTerry2 1.1.2. With priorSd > 0 each
// value has a normal prior of that standard deviation around 0 and the scale is the posterior mode
// with Laplace's covariance, finite even where somebody never won. Absent where the maximum is not
// finite (connection().tiers), or groups were never compared.
std::optional<Scale> bradleyTerry(const Wins& wins, std::optional<double> priorSd = {});

// P(i preferred to j) = Phi((values(i) - values(j)) probit(0.75)): Thurstone, Psychol. Rev. 34
// (1927) 273, case V, by maximum likelihood. Values are JOD: one more is 75 % of the votes
// (Perez-Ortiz and Mantiuk, arXiv:1712.03686). Agrees with R's glm(binomial("probit")). The rest as
// for bradleyTerry().
std::optional<Scale> thurstone(const Wins& wins, std::optional<double> priorSd = {});

// The classical least-squares solution of case V in JOD, sum 0: row means of probit(share), and
// for incomplete designs Morrissey, J. Opt. Soc. Am. 45 (1955) 373. Absent where a compared pair
// was unanimous (its probit is infinite) or groups were never compared.
std::optional<Eigen::VectorXd> thurstoneLeastSquares(const Wins& wins);

// Mosteller, Psychometrika 16 (1951) 207: do the shares fit these values (JOD) of case V? Sum of
// n (2 asin sqrt(share) - 2 asin sqrt(predicted))^2 over the pairs compared, chi-square with pairs
// - (n - 1) degrees of freedom. Absent without a degree of freedom.
std::optional<Test> mosteller(const Wins& wins, const Eigen::VectorXd& jods);

// The same scale with the item `reference` (0 ... n - 1) at 0, its variance 0, and those of the
// others from it.
Scale relativeTo(const Scale& scale, int reference);

// values(item) - values(other), and Wald's two-sided test that it is 0; items differ.
Estimate difference(const Scale& scale, int item, int other);
Test differenceTest(const Scale& scale, int item, int other);

// Likelihood-ratio tests: does the scale fit the shares (absent without a degree of freedom), and
// are all items equal?
std::optional<Test> fitTest(const Scale& scale);
Test equalityTest(const Scale& scale);

// For those who make scales: what a tie or a ranking shares with a choice.
void checkWins(const Wins& wins);
Eigen::MatrixXd centred(const Eigen::MatrixXd& covariance); // of values made to sum to 0
double xLogX(double x, double y);                           // x log(y), 0 where x = 0
Scale inUnits(Scale scale, double unit);                    // values and covariance / unit, unit^2

} // namespace obscura
