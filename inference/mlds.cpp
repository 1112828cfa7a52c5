#include "inference/mlds.h"

#include "base/error.h"

#include "inference/glm.h"
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

// A row for each answer: what speaks for the second pair. Level 0 stays at 0, level l is
// coefficient l - 1.
BinomialData rowsOf(int levels, std::span<const Quadruple> answers) {
    const auto rows = static_cast<Eigen::Index>(answers.size());
    Eigen::MatrixXd signs = Eigen::MatrixXd::Zero(rows, levels);
    BinomialData data{
        .design = {}, .successes = Eigen::VectorXd(rows), .trials = Eigen::VectorXd::Ones(rows)};
    for (Eigen::Index row = 0; row < rows; ++row) {
        const Quadruple& q = answers[static_cast<std::size_t>(row)];
        checkQuadruple(levels, q);
        signs(row, std::max(q.c, q.d)) += 1;
        signs(row, std::min(q.c, q.d)) -= 1;
        signs(row, std::max(q.a, q.b)) -= 1;
        signs(row, std::min(q.a, q.b)) += 1;
        data.successes(row) = q.isSecondLarger ? 1 : 0;
    }
    data.design = signs.rightCols(levels - 1);
    return data;
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
        throw Error(
            fmt::format("expected at least 3 levels to scale differences, found {}", levels));
    const GlmFit fit = fitGlm(rowsOf(levels, answers), {.link = Link::probit});
    if (!fit.converged)
        return std::nullopt;
    DifferenceScale scale;
    scale.logLikelihood = fit.logLikelihood;
    scale.values = Eigen::VectorXd::Zero(levels);
    scale.covariance = Eigen::MatrixXd::Zero(levels, levels);
    scale.values.tail(levels - 1) = fit.coefficients;
    scale.covariance.bottomRightCorner(levels - 1, levels - 1) = fit.covariance;
    if (std::abs(scale.values(levels - 1)) < 1e-9)
        return std::nullopt;
    standardise(scale);
    return scale;
}

} // namespace obscura
