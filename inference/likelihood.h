#pragma once

#include "inference/jet.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace obscura {

// The noise that a difference of two impressions is seen through: logistic (Bradley and Terry
// 1952), or normal with standard deviation 1 (Thurstone 1927, case V).
enum class Noise { logistic, normal };

double probability(Noise noise, double x); // F(x), relative precision kept in the lower tail
double logProbability(Noise noise, double x);

// log F and its first two derivatives, finite and precise however far out x lies.
struct LogProbability {
    double value, first, second;
};
LogProbability logProbabilityWithDerivatives(Noise noise, double x);

template <int N>
Jet<N> logProbability(Noise noise, const Jet<N>& x) {
    const LogProbability f = logProbabilityWithDerivatives(noise, x.value);
    return x.through(f.value, f.first, f.second);
}

// A linear function of the parameters.
struct Term {
    int parameter;
    double factor;
};
using Predictor = std::vector<Term>;

double valueOf(const Predictor& predictor, const Eigen::VectorXd& parameters);

// Adds to a gradient and a Hessian (left alone where it has no size) what a function of some
// predictors contributes, and gives its value.
template <int N>
double add(const Jet<N>& jet, const std::array<const Predictor*, N>& predictors,
           Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) {
    for (int a = 0; a < N; ++a)
        for (const Term& row : *predictors[a]) {
            gradient(row.parameter) += jet.first(a) * row.factor;
            for (int b = 0; b < N && hessian.size() > 0; ++b)
                for (const Term& column : *predictors[b])
                    hessian(row.parameter, column.parameter) +=
                        jet.second(a, b) * row.factor * column.factor;
        }
    return jet.value;
}

} // namespace obscura
