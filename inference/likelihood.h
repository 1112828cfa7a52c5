#pragma once

#include "inference/jet.h"
#include "inference/link.h"
#include <Eigen/Core>

#include <array>
#include <vector>

namespace obscura {

// log F(x) of a link's distribution.
template <int N>
Jet<N> logProbability(Link link, const Jet<N>& x) {
    const Evidence of = evidence(link, x.value, 1, 1);
    return x.through(of.value, of.slope, of.curvature);
}

// A linear function of the parameters.
struct Term {
    int parameter;
    double factor;
};
using Predictor = std::vector<Term>;

// Adds to a gradient and a Hessian what a function of some predictors contributes, and gives its
// value.
template <int N>
double add(const Jet<N>& jet, const std::array<const Predictor*, N>& predictors,
           Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) {
    for (std::size_t a = 0; a < N; ++a)
        for (const Term& row : *predictors[a]) {
            gradient(row.parameter) += jet.first(static_cast<int>(a)) * row.factor;
            for (std::size_t b = 0; b < N; ++b)
                for (const Term& column : *predictors[b])
                    hessian(row.parameter, column.parameter) +=
                        jet.second(static_cast<int>(a), static_cast<int>(b)) * row.factor *
                        column.factor;
        }
    return jet.value;
}

} // namespace obscura
