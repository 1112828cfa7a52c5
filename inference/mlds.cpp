#include "inference/mlds.h"
#include "base/error.h"
#include "inference/newton.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

void checkQuadruple(int levels, const Quadruple& q) {
    for (const int level : {q.a, q.b, q.c, q.d})
        if (level < 0 || level >= levels)
            throw Error(fmt::format("expected levels from 0 to {}, found {}", levels - 1, level));
    if (q.a == q.b || q.c == q.d)
        throw Error(fmt::format("expected two levels in each pair, found ({}, {}) and ({}, {})",
                                q.a, q.b, q.c, q.d));
}

// What speaks for the second pair; level 0 stays at 0, level l is parameter l - 1.
Predictor predictorOf(const Quadruple& q) {
    const std::pair<int, double> signs[] = {{std::max(q.c, q.d), 1},
                                            {std::min(q.c, q.d), -1},
                                            {std::max(q.a, q.b), -1},
                                            {std::min(q.a, q.b), 1}};
    Predictor predictor;
    for (const auto& [level, sign] : signs)
        if (level > 0)
            predictor.push_back({level - 1, q.isSecondLarger ? sign : -sign});
    return predictor;
}

// value / last, and its standard error by the delta method.
void standardise(DifferenceScale& scale) {
    const auto last = scale.values.size() - 1;
    const double unit = scale.values(last);
    scale.sigma = 1 / unit;
    scale.standard = scale.values / unit;
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Identity(last + 1, last + 1) / unit;
    slopes.col(last) -= scale.values / (unit * unit);
    scale.standardErrors =
        (slopes * scale.covariance * slopes.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
}

} // namespace

std::optional<DifferenceScale> differenceScale(int levels, std::span<const Quadruple> answers) {
    if (levels < 3)
        throw Error(fmt::format("expected at least 3 levels to scale differences, found {}", levels));
    std::vector<Predictor> predictors;
    for (const Quadruple& answer : answers) {
        checkQuadruple(levels, answer);
        predictors.push_back(predictorOf(answer));
    }
    const auto objective = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient,
                               Eigen::MatrixXd& hessian) {
        double value = 0;
        for (const Predictor& predictor : predictors) {
            const auto evidence = Jet<1>::variable(valueOf(predictor, x), 0);
            value += add<1>(-logProbability(Noise::normal, evidence), {&predictor}, gradient,
                            hessian);
        }
        return value;
    };
    const auto minimum = minimise(objective, Eigen::VectorXd::Zero(levels - 1));
    if (!minimum)
        return std::nullopt;
    DifferenceScale scale;
    scale.logLikelihood = -minimum->value;
    scale.values = Eigen::VectorXd::Zero(levels);
    scale.covariance = Eigen::MatrixXd::Zero(levels, levels);
    scale.values.tail(levels - 1) = minimum->at;
    scale.covariance.bottomRightCorner(levels - 1, levels - 1) = minimum->inverseHessian;
    if (std::abs(scale.values(levels - 1)) < 1e-9)
        return std::nullopt;
    standardise(scale);
    return scale;
}

} // namespace obscura
