#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>

namespace obscura {

// Of two pairs of levels of one thing, (a, b) and (c, d), which pair differs more? Levels number
// from 0 in the order of the thing's amount; within a pair their order does not matter. A triad
// (a, b, c) is a = a, b = b, c = b, d = c.
struct Quadruple {
    int a = 0, b = 0, c = 0, d = 0;
    bool isSecondLarger = false;
};

// Maximum likelihood difference scaling: P(second) = Phi((psi(d) - psi(c)) - (psi(b) - psi(a))),
// levels ascending in each pair; Maloney and Yang, J. Vision 3 (2003) 573, fitted as a probit
// regression (Knoblauch and Maloney, J. Stat. Softw. 25 (2008) 2). psi(0) = 0, and the unit is the
// standard deviation of the judgement's noise. Agrees with R's glm(binomial("probit")) on the
// design that the package MLDS makes.
struct DifferenceScale {
    Eigen::VectorXd values;     // psi
    Eigen::MatrixXd covariance; // row and column 0 are 0
    double logLikelihood = 0;

    // The same with the last level at 1; sigma is the noise in that unit.
    Eigen::VectorXd standard, standardErrors;
    double sigma = 0;
};

// Absent where the likelihood has no finite maximum (answers that a scale explains without noise),
// or the last level equals the first. Error where the answers cannot tell the levels apart: one was
// never shown, or there are fewer kinds of quadruples than levels.
std::optional<DifferenceScale> differenceScale(int levels, std::span<const Quadruple> answers);

} // namespace obscura
