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
           solver.eigenvalues().cwiseInverse().asDiagonal() *
           solver.eigenvectors().transpose() * unit.asDiagonal();
}

struct Point {
    Eigen::VectorXd x, gradient;
    Eigen::MatrixXd hessian;
    double value = 0;

    Point(const Objective& objective, Eigen::VectorXd at, bool second)
        : x(std::move(at)), gradient(Eigen::VectorXd::Zero(x.size())) {
        if (second)
            hessian = Eigen::MatrixXd::Zero(x.size(), x.size());
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

std::optional<Minimum> minimise(const Objective& objective, const Eigen::VectorXd& start) {
    Point point(objective, start, true);
    double damping = 0;
    for (int step = 0; step < maximumSteps && point.isFinite() && damping < 1e12; ++step) {
        const Eigen::VectorXd move = newtonStep(point, damping);
        const double descent = move.size() == 0 ? 0 : -move.dot(point.gradient);
        if (move.size() > 0 && damping == 0 && descent < negligible(point.value) * 1e-3) {
            point = Point(objective, point.x + move, true); // the last step squares the error
            const auto covariance = inverse(point.hessian);
            if (!covariance)
                return std::nullopt;
            return Minimum{point.x, point.value, *covariance};
        }
        Point next = move.size() == 0 ? point : Point(objective, point.x + move, true);
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

namespace {

// Halves the step until the value falls by a share of what the slope promises (Armijo 1966).
std::optional<Point> descend(const Objective& objective, const Point& from,
                             const Eigen::VectorXd& direction) {
    const double slope = direction.dot(from.gradient);
    for (double length = 1; length > 1e-12; length /= 2) {
        Point next(objective, from.x + length * direction, false);
        if (next.isFinite() && next.value <= from.value + 1e-4 * length * slope)
            return next;
    }
    return std::nullopt;
}

void updateInverse(Eigen::MatrixXd& inverse, const Eigen::VectorXd& moved,
                   const Eigen::VectorXd& turned) {
    const double curvature = moved.dot(turned);
    if (curvature <= 1e-14 * moved.norm() * turned.norm())
        return;
    const Eigen::VectorXd image = inverse * turned;
    inverse += (1 + turned.dot(image) / curvature) / curvature * moved * moved.transpose() -
               (image * moved.transpose() + moved * image.transpose()) / curvature;
}

} // namespace

std::optional<Minimum> minimiseByGradient(const Objective& objective,
                                          const Eigen::VectorXd& start) {
    Point point(objective, start, false);
    const auto size = start.size();
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(size, size);
    inverse /= std::max(1.0, point.gradient.norm());
    const double enough = 1e-9 * (1 + std::abs(point.value));
    bool isFresh = true; // the inverse Hessian is a guess
    for (int step = 0; step < 10 * maximumSteps && point.isFinite(); ++step) {
        if (point.gradient.lpNorm<Eigen::Infinity>() < enough)
            return Minimum{point.x, point.value, {}};
        auto next = descend(objective, point, -(inverse * point.gradient));
        if (!next) { // no descent is left but in rounding, or the inverse has gone astray
            if (isFresh)
                break;
            inverse = Eigen::MatrixXd::Identity(size, size) / std::max(1.0, point.gradient.norm());
            isFresh = true;
            continue;
        }
        updateInverse(inverse, next->x - point.x, next->gradient - point.gradient);
        isFresh = false;
        point = std::move(*next);
    }
    if (!point.isFinite() || point.gradient.lpNorm<Eigen::Infinity>() > 1e4 * enough)
        return std::nullopt;
    return Minimum{point.x, point.value, {}};
}

} // namespace obscura
