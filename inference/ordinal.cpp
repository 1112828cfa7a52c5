#include "inference/ordinal.h"

#include "base/error.h"

#include "inference/glm.h"
#include "inference/ordinal_rows.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace obscura {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// How many ratings each category has.
std::vector<int> check(const OrdinalData& data) {
    const auto rows = static_cast<Index>(data.category.size());
    if (data.design.rows() != rows)
        throw Error(fmt::format("expected a category for each of {} rows of the design, found {}",
                                data.design.rows(), rows));
    if (!data.design.allFinite())
        throw Error("the design of a model has a value that is not finite; leave out the row");
    if (rows == 0 || *std::min_element(data.category.begin(), data.category.end()) < 0)
        throw Error("expected ratings in categories 0, 1, ..., found none or a negative one");
    const int highest = *std::max_element(data.category.begin(), data.category.end());
    std::vector<int> counts(static_cast<std::size_t>(highest) + 1, 0);
    for (const int category : data.category)
        ++counts[static_cast<std::size_t>(category)];
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] == 0)
            throw Error(fmt::format("category {} is never used, so its threshold does not exist; "
                                    "number only the categories that are",
                                    i));
    if (highest == 0)
        throw Error("expected ratings in two categories or more, found one");
    MatrixXd withIntercept(rows, data.design.cols() + 1);
    withIntercept << VectorXd::Ones(rows), data.design;
    requireFullRank(withIntercept);
    return counts;
}

void unpack(const VectorXd& parameters, const MatrixXd& covariance, Index thresholds,
            OrdinalFit& fit) {
    const Index columns = fit.coefficients.size();
    fit.thresholds = parameters.head(thresholds);
    fit.coefficients = parameters.segment(thresholds, columns);
    fit.covariance = covariance.topLeftCorner(thresholds + columns, thresholds + columns);
}

OrdinalFit fitWithoutPeople(OrdinalRows& rows, const OrdinalData& data,
                            const std::vector<int>& counts, Link link) {
    const auto thresholds = static_cast<Index>(counts.size()) - 1;
    const Index columns = data.design.cols();
    const auto n = static_cast<double>(data.category.size());
    VectorXd start = VectorXd::Zero(thresholds + columns);
    VectorXd variances = VectorXd::Constant(thresholds + columns, 4 / n);
    double below = 0;
    for (Index i = 0; i < thresholds; ++i) {
        below += counts[static_cast<std::size_t>(i)];
        start[i] = quantile(link, below / n);
    }
    for (Index j = 0; j < columns; ++j)
        variances[thresholds + j] = 4 / data.design.col(j).squaredNorm();
    const Maximum best = maximise(
        [&](const VectorXd& x, VectorXd& gradient) { return rows.withoutPeople(x, gradient); },
        start, variances.asDiagonal());
    OrdinalFit fit;
    fit.logLikelihood = best.value;
    fit.converged = best.reached;
    fit.coefficients.resize(columns);
    unpack(best.at, best.covariance, thresholds, fit);
    return fit;
}

bool tellsPersons(const PersonOrder& order) {
    int persons = 0;
    bool repeated = false;
    for (std::size_t i = 0; i + 1 < order.first.size(); ++i) {
        persons += order.first[i + 1] > order.first[i];
        repeated |= order.first[i + 1] > order.first[i] + 1;
    }
    return persons > 1 && repeated;
}

} // namespace

OrdinalFit fitOrdinal(const OrdinalData& data, Link link) {
    const std::vector<int> counts = check(data);
    OrdinalRows rows(data, {}, static_cast<Index>(counts.size()) - 1, link);
    return fitWithoutPeople(rows, data, counts, link);
}

OrdinalMixedFit fitOrdinalMixed(const OrdinalData& data, std::span<const int> person, Link link,
                                int points) {
    const std::vector<int> counts = check(data);
    const auto thresholds = static_cast<Index>(counts.size()) - 1;
    const PersonOrder order = orderByPerson(person, data.design.rows());
    OrdinalRows rows(data, order, thresholds, link);
    OrdinalMixedFit fit{fitWithoutPeople(rows, data, counts, link)};
    fit.identified = tellsPersons(order);
    if (!fit.identified)
        return fit;

    const Index size = thresholds + data.design.cols();
    VectorXd start(size + 1);
    start << fit.thresholds, fit.coefficients, 1;
    MatrixXd covariance = MatrixXd::Zero(size + 1, size + 1);
    covariance.topLeftCorner(size, size) = fit.covariance;
    covariance(size, size) = 1.0 / rows.persons();
    RandomIntercept likelihood(rows, points);
    const Maximum best = maximise(
        [&](const VectorXd& x, VectorXd& gradient) {
            return std::abs(x[size]) > 2 * largestSd ? -std::numeric_limits<double>::infinity()
                                                     : likelihood(x, gradient);
        },
        start, covariance);
    fit.boundary = best.value <= fit.logLikelihood + 1e-9;
    if (fit.boundary)
        return fit;
    unpack(best.at, best.covariance, thresholds, fit);
    fit.logLikelihood = best.value;
    fit.sd = std::abs(best.at[size]);
    fit.separated = fit.sd > largestSd;
    fit.converged = best.reached && !fit.separated;
    if (fit.converged)
        fit.sdError = std::sqrt(best.covariance(size, size));
    return fit;
}

} // namespace obscura
