#include "analysis/scales/scale_result.h"

#include "inference/bootstrap.h"
#include "inference/link.h"
#include "inference/multiplicity.h"
#include "inference/tails.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace obscura {

namespace {

constexpr int samples = 2000;

// Rows: one for each item but the first, and one for each step; columns: the scale's values.
Eigen::MatrixXd contrasts(const ScaleResult& result) {
    const auto n = static_cast<Eigen::Index>(result.items.size());
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 * (n - 1), n);
    for (Eigen::Index i = 1; i < n; ++i) {
        rows(i - 1, i) = 1;
        rows(i - 1, 0) = -1;
    }
    for (std::size_t i = 0; i < result.steps.size(); ++i) {
        const auto row = n - 1 + static_cast<Eigen::Index>(i);
        rows(row, static_cast<Eigen::Index>(result.steps[i].to)) += 1;
        rows(row, static_cast<Eigen::Index>(result.steps[i].from)) -= 1;
    }
    return rows;
}

void setErrors(ScaleResult& result, const Eigen::VectorXd& errors,
               const std::vector<Interval>& intervals) {
    const std::size_t others = result.items.size() - 1;
    for (std::size_t i = 0; i < others; ++i) {
        result.items[i + 1].standardError = errors(static_cast<Eigen::Index>(i));
        result.items[i + 1].interval = {intervals[i].low, intervals[i].high};
    }
    for (std::size_t i = 0; i < result.steps.size(); ++i) {
        ScaleStep& step = result.steps[i];
        const double error = errors(static_cast<Eigen::Index>(others + i));
        step.standardError = error;
        step.interval = {intervals[others + i].low, intervals[others + i].high};
        if (error > 0)
            step.p = normalP(step.difference / error);
    }
}

// The confidence of percentiles that cover 95 % although people are few: as much further out as
// Student's t is than the normal, and as people vary more than resampled ones (Hesterberg's
// expanded percentiles, Am. Stat. 69 (2015) 371).
double expandedConfidence(int people) {
    const double n = people;
    return 1 - normalP(std::sqrt(n / (n - 1)) * studentQuantile(0.975, n - 1));
}

bool resample(ScaleResult& result, const Eigen::MatrixXd& rows, const Refit& refit) {
    if (!refit || result.group.people < fewestPeople)
        return false;
    const auto found =
        bootstrap(result.group.people,
                  [&](std::span<const int> times) -> std::optional<Eigen::VectorXd> {
                      const auto values = refit(times);
                      if (!values || !values->allFinite())
                          return std::nullopt;
                      return Eigen::VectorXd(rows * *values);
                  },
                  {.samples = samples, .confidence = expandedConfidence(result.group.people)});
    if (!found)
        return false;
    setErrors(result, found->standardErrors, found->percentile);
    result.intervals = fmt::format("bootstrap over {} people, {} samples, expanded percentiles",
                                   result.group.people, samples);
    return true;
}

void propagate(ScaleResult& result, const Eigen::MatrixXd& rows,
               const Eigen::MatrixXd& covariance) {
    const Eigen::VectorXd errors =
        (rows * covariance * rows.transpose()).diagonal().array().max(0).sqrt();
    const double z = quantile(Link::probit, 0.975);
    std::vector<Interval> intervals;
    for (std::size_t i = 0; i + 1 < result.items.size(); ++i) {
        const double error = z * errors(static_cast<Eigen::Index>(i));
        intervals.push_back({result.items[i + 1].value - error, result.items[i + 1].value + error});
    }
    for (std::size_t i = 0; i < result.steps.size(); ++i) {
        const double error = z * errors(static_cast<Eigen::Index>(result.items.size() - 1 + i));
        intervals.push_back(
            {result.steps[i].difference - error, result.steps[i].difference + error});
    }
    setErrors(result, errors, intervals);
}

// Why people were not resampled.
std::string whyNot(const ScaleResult& result, const Refit& refit) {
    if (result.group.people == 0)
        return "nobody knows who answered what";
    if (!refit)
        return "people are not told apart";
    if (result.group.people < fewestPeople)
        return fmt::format("{} people are too few to resample", result.group.people);
    return "resampled people too often leave no finite scale";
}

} // namespace

ScaleResult resultOf(const ScaleGroup& group, std::string unit) {
    ScaleResult result{group, std::move(unit), {}, {}, {}, {}, group.notes};
    result.group.notes.clear();
    return result;
}

std::vector<std::size_t> orderOf(const ScaleResult& result) {
    const std::vector<ScaleItem>& items = result.items;
    std::vector<std::size_t> order(items.size());
    std::iota(order.begin(), order.end(), 0);
    if (result.isOrdered)
        return order;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t x, std::size_t y) { return items[x].value < items[y].value; });
    return order;
}

void correctSteps(ScaleResult& result) {
    std::vector<double> p;
    for (const ScaleStep& step : result.steps)
        if (step.p)
            p.push_back(*step.p);
    const std::vector<double> adjusted = holm(p);
    std::size_t next = 0;
    for (ScaleStep& step : result.steps)
        if (step.p)
            step.holm = adjusted[next++];
}

void addScale(ScaleResult& result, const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance,
              const Refit& refit) {
    for (std::size_t i = 0; i < result.group.items.size(); ++i)
        result.items.push_back(
            {result.group.items[i], values(static_cast<Eigen::Index>(i)) - values(0)});
    const std::vector<std::size_t> order = orderOf(result);
    for (std::size_t i = 0; i + 1 < order.size(); ++i)
        result.steps.push_back({order[i], order[i + 1],
                                result.items[order[i + 1]].value - result.items[order[i]].value});
    const Eigen::MatrixXd rows = contrasts(result);
    if (!resample(result, rows, refit)) {
        if (covariance.size() > 0) {
            propagate(result, rows, covariance);
            result.intervals = fmt::format("from the curvature of the likelihood, which takes all "
                                           "answers for independent ({})",
                                           whyNot(result, refit));
        } else {
            result.intervals = fmt::format("none ({})", whyNot(result, refit));
        }
    }
    correctSteps(result);
}

} // namespace obscura
