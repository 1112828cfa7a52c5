#include "inference/newton.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>

namespace obscura {
namespace {

constexpr int maximumSteps = 200;
constexpr double leastCurvature = 1e-8; // of the Hessian with a unit diagonal

// Where the Hessian is positive definite beyond doubt; in units in which its diagonal is 1, so
// that parameters of different sizes are alike.
std::optional<Eigen::MatrixXd> inverse(const Eigen::MatrixXd& hessian) {
    if (!hessian.allFinite() || (hessian.diagonal().array() <= 1e-9).any())
        return std::nullopt;
    const Eigen::VectorXd unit = hessian.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(unit.asDiagonal() * hessian *
                                                                unit.asDiagonal());
    if (solver.info() != Eigen::Success || solver.eigenvalues()(0) < leastCurvature)
        return std::nullopt;
    return unit.asDiagonal() * solver.eigenvectors() *
           solver.eigenvalues().cwiseInverse().asDiagonal() * solver.eigenvectors().transpose() *
           unit.asDiagonal();
}

struct Point {
    Eigen::VectorXd x, gradient;
    Eigen::MatrixXd hessian;
    double value = 0;

    Point(const CurvedObjective& objective, Eigen::VectorXd at)
        : x(std::move(at)), gradient(Eigen::VectorXd::Zero(x.size())),
          hessian(Eigen::MatrixXd::Zero(x.size(), x.size())) {
        value = objective(x, gradient, hessian);
    }
    bool isFinite() const {
        return std::isfinite(value) && gradient.allFinite() && hessian.allFinite();
    }
};

// Rounding of the value hides a descent smaller than this.
double negligible(double value) { return 1e-13 * (1 + std::abs(value)); }

Eigen::VectorXd newtonStep(const Point& point, double damping) {
    Eigen::MatrixXd raised = point.hessian;
    const double floor = 1e-8 * (1 + raised.diagonal().cwiseAbs().maxCoeff());
    raised.diagonal() += damping * raised.diagonal().cwiseAbs().cwiseMax(floor);
    const Eigen::LLT<Eigen::MatrixXd> factor(raised);
    if (factor.info() != Eigen::Success)
        return {};
    return -factor.solve(point.gradient);
}

} // namespace

std::optional<Minimum> minimise(const CurvedObjective& objective, const Eigen::VectorXd& start) {
    Point point(objective, start);
    double damping = 0;
    for (int step = 0; step < maximumSteps && point.isFinite() && damping < 1e12; ++step) {
        const Eigen::VectorXd move = newtonStep(point, damping);
        const double descent = move.size() == 0 ? 0 : -move.dot(point.gradient);
        if (move.size() > 0 && damping == 0 && descent < negligible(point.value) * 1e-3) {
            point = Point(objective, point.x + move); // the last step squares the error
            const auto covariance = inverse(point.hessian);
            if (!covariance)
                return std::nullopt;
            return Minimum{point.x, point.value, *covariance};
        }
        Point next = move.size() == 0 ? point : Point(objective, point.x + move);
        if (move.size() > 0 && next.isFinite() &&
            next.value <= point.value + negligible(point.value)) {
            point = std::move(next);
            damping = damping < 1e-6 ? 0 : damping / 10;
        } else {
            damping = std::max(1e-4, damping * 10);
        }
    }
    return std::nullopt;
}

} // namespace obscura
