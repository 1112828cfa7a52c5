#pragma once

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace obscura {

// Fills in gradient and Hessian at x and gives the value there.
using Objective = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd& gradient,
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
std::optional<Minimum> minimise(const Objective& objective, const Eigen::VectorXd& start);

// The same from gradients alone (Broyden, Fletcher, Goldfarb, Shanno 1970), where the Hessian
// would cost too much; the Hessian that `objective` is handed has no size. `inverseHessian` is
// empty.
std::optional<Minimum> minimiseByGradient(const Objective& objective, const Eigen::VectorXd& start);

} // namespace obscura
