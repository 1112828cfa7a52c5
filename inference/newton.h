#pragma once

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace obscura {

// Adds to gradient and Hessian, which are zero, those at x, and gives the value there. Where a
// Hessian costs too much, optimise.h needs none.
using CurvedObjective = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient,
                                             Eigen::MatrixXd& hessian)>;

struct Minimum {
    Eigen::VectorXd at;
    double value = 0;
    Eigen::MatrixXd inverseHessian; // of a -log likelihood: the covariance
};

// The minimum that Newton's steps lead to from `start`; the diagonal of the Hessian is raised where
// a step would not descend (Marquardt 1963). Absent when there is none: the objective falls
// forever along a direction, in which its curvature has vanished against that of others (less than
// 1e-8 of the diagonal's scale), or 200 steps do not get there.
std::optional<Minimum> minimise(const CurvedObjective& objective, const Eigen::VectorXd& start);

} // namespace obscura
