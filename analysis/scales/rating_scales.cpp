#include "analysis/scales/scale_kinds.h"

#include "inference/agreement.h"
#include "inference/ordinal.h"
#include "inference/paired.h"
#include <Eigen/Dense>
#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace obscura {

namespace {

constexpr std::size_t mostSteps = 12;      // of a scale that is taken for ordered categories
constexpr std::size_t mostRatings = 50000; // for a model of people

// Of each person the mean rating of each item; NaN where there is none.
Eigen::MatrixXd meansOf(const Ratings& group) {
    const auto n = static_cast<Eigen::Index>(group.items.size());
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(group.people, n), count = sum;
    for (const Ratings::Rating& rating : group.ratings) {
        sum(rating.person, rating.item) += rating.value;
        count(rating.person, rating.item) += 1;
    }
    return (sum.array() / count.array()).matrix(); // 0 / 0 is NaN
}

std::vector<double> known(const Eigen::VectorXd& values) {
    std::vector<double> list;
    for (const double value : values)
        if (!std::isnan(value))
            list.push_back(value);
    return list;
}

struct Mean {
    double value = 0;
    std::optional<double> error; // absent for one number
    double quantile = 0;         // Student's, 97.5 %
};

Mean meanOf(const std::vector<double>& values) {
    Mean mean;
    const auto n = static_cast<double>(values.size());
    for (const double value : values)
        mean.value += value;
    mean.value /= n;
    double squares = 0;
    for (const double value : values)
        squares += (value - mean.value) * (value - mean.value);
    if (values.size() > 1) {
        mean.error = std::sqrt(squares / (n - 1) / n);
        mean.quantile = boost::math::quantile(boost::math::students_t(n - 1), 0.975);
    }
    return mean;
}

// The interval, within the scale's range where that is known.
OpenInterval intervalOf(const Mean& mean, const std::optional<std::pair<int, int>>& range) {
    if (!mean.error)
        return {};
    double low = mean.value - mean.quantile * *mean.error,
           high = mean.value + mean.quantile * *mean.error;
    if (range) {
        low = std::max<double>(low, range->first);
        high = std::min<double>(high, range->second);
    }
    return {low, high};
}

void addCounts(ScaleResult& result, const Ratings& group) {
    for (std::size_t i = 0; i < result.items.size(); ++i) {
        std::map<double, int> counts;
        for (const Ratings::Rating& rating : group.ratings)
            if (rating.item == static_cast<int>(i))
                ++counts[rating.value];
        if (counts.size() <= mostSteps)
            result.items[i].counts.assign(counts.begin(), counts.end());
    }
}

// Neighbours on the scale, on those people who rated both.
void addPairedSteps(ScaleResult& result, const Eigen::MatrixXd& means) {
    const std::vector<std::size_t> order = orderOf(result);
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
        const Eigen::VectorXd differences = means.col(static_cast<Eigen::Index>(order[i + 1])) -
                                            means.col(static_cast<Eigen::Index>(order[i]));
        const std::vector<double> both = known(differences);
        ScaleStep step{order[i], order[i + 1],
                       result.items[order[i + 1]].value - result.items[order[i]].value};
        const Mean mean = meanOf(both);
        step.standardError = mean.error;
        step.interval = intervalOf(mean, std::nullopt);
        if (const auto test = tTest(both, 0))
            step.p = test->p;
        result.steps.push_back(step);
    }
    correctSteps(result);
}

void addAgreement(ScaleResult& result, const Eigen::MatrixXd& means) {
    std::vector<std::vector<double>> complete;
    for (Eigen::Index person = 0; person < means.rows(); ++person) {
        const std::vector<double> row = known(means.row(person).transpose());
        if (static_cast<Eigen::Index>(row.size()) == means.cols())
            complete.push_back(row);
    }
    if (const auto w = concordance(complete))
        result.diagnostics.push_back(
            {fmt::format("Kendall's W of {} people's ratings; Friedman", complete.size()), w->w,
             w->friedman});
}

// Differences of items from the first one, and last what the second place adds: least squares.
std::optional<Eigen::VectorXd> leastSquares(const Ratings& group, std::span<const int> times) {
    const auto n = static_cast<Eigen::Index>(group.items.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    for (const Ratings::Rating& rating : group.ratings) {
        const double weight = times.empty() ? 1 : times[static_cast<std::size_t>(rating.person)];
        Eigen::VectorXd row = Eigen::VectorXd::Zero(n); // items 1 ... n - 1, the place
        if (rating.item > 0)
            row(rating.item - 1) += 1;
        if (rating.than > 0)
            row(rating.than - 1) -= 1;
        row(n - 1) = 1;
        normal += weight * row * row.transpose();
        right += weight * rating.value * row;
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> solver(normal);
    if (!solver.isInvertible())
        return std::nullopt;
    return Eigen::VectorXd(solver.solve(right));
}

// From the first item at 0.
Eigen::VectorXd fromFirst(const Eigen::VectorXd& solution) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(solution.size());
    values.tail(solution.size() - 1) = solution.head(solution.size() - 1);
    return values;
}

// The values that were given, as categories from 0; nothing where they are too many or one.
std::optional<std::vector<int>> categoriesOf(const Ratings& group) {
    std::set<double> values;
    for (const Ratings::Rating& rating : group.ratings)
        values.insert(rating.value);
    if (values.size() < 2 || values.size() > mostSteps)
        return std::nullopt;
    std::vector<int> categories;
    for (const Ratings::Rating& rating : group.ratings)
        categories.push_back(
            static_cast<int>(std::distance(values.begin(), values.find(rating.value))));
    return categories;
}

ScaleResult cumulativeLinkOf(const Ratings& group) {
    ScaleResult result = resultOf(group, "logit");
    const auto categories = categoriesOf(group);
    const auto rows = static_cast<Eigen::Index>(group.ratings.size());
    if (!categories || group.ratings.size() > mostRatings) {
        result.notes.push_back(categories ? "not fitted to so many ratings"
                                          : "everybody gave the same rating, or the scale has too "
                                            "many steps to be categories");
        return result;
    }
    const auto n = static_cast<Eigen::Index>(group.items.size());
    OrdinalData data{Eigen::MatrixXd::Zero(rows, n - 1), *categories};
    std::vector<int> people;
    for (Eigen::Index i = 0; i < rows; ++i) {
        const Ratings::Rating& rating = group.ratings[static_cast<std::size_t>(i)];
        if (rating.item > 0)
            data.design(i, rating.item - 1) += 1;
        if (rating.than > 0)
            data.design(i, rating.than - 1) -= 1;
        people.push_back(rating.person);
    }
    const OrdinalMixedFit fit = fitOrdinalMixed(data, people);
    if (!fit.converged || fit.separated) {
        result.notes.push_back("no finite fit: a technique has only ratings of one end of the "
                               "scale");
        return result;
    }
    Eigen::VectorXd values = Eigen::VectorXd::Zero(n);
    values.tail(n - 1) = fit.coefficients;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
    covariance.bottomRightCorner(n - 1, n - 1) =
        fit.covariance.block(fit.thresholds.size(), fit.thresholds.size(), n - 1, n - 1);
    addScale(result, values, covariance, {});
    result.intervals = fit.identified
                           ? "from the curvature of the likelihood, people as random intercepts"
                           : "from the curvature of the likelihood; people are not told apart";
    result.diagnostics.push_back({"standard deviation between people, logits", fit.sd});
    return result;
}

} // namespace

std::vector<ScaleResult> meanRatings(const ScaleData& data) {
    std::vector<ScaleResult> results;
    for (const Ratings& group : data.ratings) {
        if (group.isComparison || group.items.empty())
            continue;
        ScaleResult result = resultOf(group, "rating");
        const Eigen::MatrixXd means = meansOf(group);
        for (std::size_t i = 0; i < group.items.size(); ++i) {
            const Mean mean = meanOf(known(means.col(static_cast<Eigen::Index>(i))));
            result.items.push_back(
                {group.items[i], mean.value, mean.error, intervalOf(mean, group.range)});
        }
        result.intervals = fmt::format("Student's t over {} people, steps paired", group.people);
        addCounts(result, group);
        addPairedSteps(result, means);
        addAgreement(result, means);
        results.push_back(std::move(result));
    }
    return results;
}

std::vector<ScaleResult> meanComparisons(const ScaleData& data) {
    std::vector<ScaleResult> results;
    for (const Ratings& group : data.ratings) {
        if (!group.isComparison || group.items.size() < 2)
            continue;
        ScaleResult result = resultOf(group, "grades");
        const auto solution = leastSquares(group, {});
        if (solution) {
            addScale(result, fromFirst(*solution), {},
                     [&](std::span<const int> times) -> std::optional<Eigen::VectorXd> {
                         const auto again = leastSquares(group, times);
                         return again ? std::optional(fromFirst(*again)) : std::nullopt;
                     });
            result.diagnostics.push_back(
                {"what the second place adds, grades", (*solution)(solution->size() - 1)});
        } else {
            result.notes.push_back("not all techniques were compared with each other, even through "
                                   "others: they have no scale together");
        }
        results.push_back(std::move(result));
    }
    return results;
}

std::vector<ScaleResult> cumulativeLinkScales(const ScaleData& data) {
    std::vector<ScaleResult> results;
    for (const Ratings& group : data.ratings)
        if (group.items.size() >= 2)
            results.push_back(cumulativeLinkOf(group));
    return results;
}

} // namespace obscura
