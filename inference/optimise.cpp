#include "inference/optimise.h"

#include "base/error.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Climber {
    const Objective& objective;
    VectorXd x, gradient;
    double value;
    int evaluations = 0;

    double evaluate(const VectorXd& at, VectorXd& into) {
        ++evaluations;
        return objective(at, into);
    }

    // The longest of the steps 1, 1/2, 1/4 ... that gains a fair part of what the slope promises
    // (within rounding of the value). False if none does.
    bool moveAlong(const VectorXd& step) {
        const double promised = gradient.dot(step), noise = 1e-13 * (1 + std::abs(value));
        VectorXd there(x.size());
        for (int halvings = 0; halvings < 33; ++halvings) {
            const double part = std::ldexp(1.0, -halvings);
            const VectorXd next = x + part * step;
            const double reached = evaluate(next, there);
            if (std::isfinite(reached) && there.allFinite() &&
                reached >= value + 1e-4 * part * promised - noise) {
                x = next;
                value = reached;
                gradient = there;
                return true;
            }
        }
        return false;
    }
};

void updateInverse(MatrixXd& inverse, const VectorXd& step, const VectorXd& fall) {
    const double curvature = step.dot(fall);
    if (curvature <= 1e-12 * step.norm() * fall.norm())
        return;
    const VectorXd moved = inverse * fall;
    const double scale = (curvature + fall.dot(moved)) / (curvature * curvature);
    inverse += scale * step * step.transpose() -
               (moved * step.transpose() + step * moved.transpose()) / curvature;
}

void quasiNewton(Climber& climber, MatrixXd inverse) {
    for (int i = 0; i < 200; ++i) {
        const VectorXd step = inverse * climber.gradient;
        if (climber.gradient.dot(step) < 1e-12)
            return;
        const VectorXd before = climber.x, slope = climber.gradient;
        if (!climber.moveAlong(step))
            return;
        updateInverse(inverse, climber.x - before, slope - climber.gradient);
    }
}

// Minus the second derivative. The steps are a hundredth of a standard error at most, so that both
// rounding and the third derivative stay below 1e-6 of the curvature.
MatrixXd information(Climber& climber, const MatrixXd& covariance) {
    const auto n = climber.x.size();
    MatrixXd result(n, n);
    VectorXd above(n), below(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double deviation = std::sqrt(std::abs(covariance(i, i)));
        const double step = std::min(1e-3 * deviation, 1e-4 * (1 + std::abs(climber.x[i])));
        VectorXd x = climber.x;
        x[i] += step;
        climber.evaluate(x, above);
        x[i] -= 2 * step;
        climber.evaluate(x, below);
        result.col(i) = (below - above) / (2 * step);
    }
    return (result + result.transpose()) / 2;
}

} // namespace

Maximum maximise(const Objective& objective, const VectorXd& start, const MatrixXd& covariance) {
    Climber climber{
        .objective = objective, .x = start, .gradient = VectorXd(start.size()), .value = 0};
    climber.value = climber.evaluate(start, climber.gradient);
    quasiNewton(climber, covariance);
    Maximum result{.at = {}, .covariance = covariance};
    for (int i = 0; i < 10 && !result.reached; ++i) {
        const MatrixXd curvature = information(climber, result.covariance);
        const Eigen::LDLT<MatrixXd> factor(curvature);
        if (!curvature.allFinite() || !factor.isPositive() || factor.vectorD().minCoeff() <= 0)
            break;
        result.covariance = factor.solve(MatrixXd::Identity(start.size(), start.size()));
        const VectorXd step = factor.solve(climber.gradient);
        const double gain = climber.gradient.dot(step);
        if (!climber.moveAlong(step))
            break;
        // On the way to infinity the likelihood flattens until nothing is left to gain.
        const bool flat =
            (result.covariance.diagonal().array() > 1e6 * covariance.diagonal().array()).any();
        result.reached = gain < 1e-8 && !flat;
    }
    result.at = climber.x;
    result.value = climber.value;
    result.evaluations = climber.evaluations;
    return result;
}

Quadrature gaussHermite(int n) {
    if (n < 1 || n > 100)
        throw Error(fmt::format("expected 1 to 100 quadrature points, found {}", n));
    MatrixXd jacobi = MatrixXd::Zero(n, n);
    for (int i = 1; i < n; ++i)
        jacobi(i, i - 1) = jacobi(i - 1, i) = std::sqrt(static_cast<double>(i));
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(jacobi);
    Quadrature rule{.nodes = solver.eigenvalues().array(),
                    .weights = solver.eigenvectors().row(0).transpose().array().square()};
    // The rule is symmetric; rounding is not.
    rule.nodes = ((rule.nodes - rule.nodes.reverse()) / 2).eval();
    rule.weights = ((rule.weights + rule.weights.reverse()) / 2).eval();
    return rule;
}

} // namespace obscura
