#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace obscura {

// A smooth function to be maximised: its value at x, with the gradient written where asked. Values
// of -infinity mark what lies outside the domain.
using Objective = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)>;

struct Maximum {
    Eigen::VectorXd at;
    double value = 0;
    // Inverse of minus the second derivative: the covariance, where `value` is a log-likelihood.
    // Meaningless unless it was reached.
    Eigen::MatrixXd covariance;
    bool reached = false; // gradient zero and curvature negative in every direction
    int evaluations = 0;
};

// Broyden, Fletcher, Goldfarb and Shanno's method with backtracking (Nocedal and Wright, Numerical
// Optimization, 2nd ed., algorithm 6.1), then Newton's steps with the second derivative as the
// central difference of the gradient. `covariance` is a guess at the inverse of minus the second
// derivative: it sets the scale of each direction and must be positive definite. Reached means
// that the last Newton step was at most 1e-4 standard errors long, so that x is right to some
// square of that, and that no standard error is beyond a thousand times that of the guess, as on
// the way to an infinite maximum.
Maximum maximise(const Objective& objective, const Eigen::VectorXd& start,
                 const Eigen::MatrixXd& covariance);

// Nodes and weights of Gauss and Hermite for the standard normal density: the sum of weight f(node)
// is the mean of f over it, exact for polynomials below degree 2 n. By Golub and Welsch, Math.
// Comp. 23 (1969) 221. n >= 1; nodes ascend and the middle one of an odd number is exactly 0.
struct Quadrature {
    Eigen::ArrayXd nodes, weights;
};
Quadrature gaussHermite(int n);

} // namespace obscura
