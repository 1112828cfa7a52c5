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

// A row for each of `pairs`; columns: the scale's values.
Eigen::MatrixXd contrasts(const ScaleResult& result) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(result.pairs.size()),
                                                 static_cast<Eigen::Index>(result.items.size()));
    for (std::size_t i = 0; i < result.pairs.size(); ++i) {
        rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(result.pairs[i].to)) = 1;
        rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(result.pairs[i].from)) = -1;
    }
    return rows;
}

// Items are differences from the first of them, and steps those of neighbours.
void setErrors(ScaleResult& result, const Eigen::VectorXd& errors,
               const std::vector<Interval>& intervals) {
    for (std::size_t i = 0; i < result.pairs.size(); ++i) {
        result.pairs[i].standardError = errors(static_cast<Eigen::Index>(i));
        result.pairs[i].interval = {intervals[i].low, intervals[i].high};
    }
    for (std::size_t i = 1; i < result.items.size(); ++i) {
        const auto fromFirst = differenceOf(result, 0, i);
        result.items[i].standardError = fromFirst->standardError;
        result.items[i].interval = fromFirst->interval;
    }
    for (ScaleStep& step : result.steps) {
        step = *differenceOf(result, step.from, step.to);
        if (*step.standardError > 0)
            step.p = normalP(step.difference / *step.standardError);
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
    for (std::size_t i = 0; i < result.pairs.size(); ++i) {
        const double error = z * errors(static_cast<Eigen::Index>(i));
        intervals.push_back(
            {result.pairs[i].difference - error, result.pairs[i].difference + error});
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

std::optional<ScaleStep> differenceOf(const ScaleResult& result, std::size_t from, std::size_t to) {
    for (const ScaleStep& pair : result.pairs) {
        if (pair.from == from && pair.to == to)
            return pair;
        if (pair.from != to || pair.to != from)
            continue;
        ScaleStep turned{from, to, -pair.difference, pair.standardError};
        if (pair.interval.high)
            turned.interval.low = -*pair.interval.high;
        if (pair.interval.low)
            turned.interval.high = -*pair.interval.low;
        return turned;
    }
    return std::nullopt;
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
    for (std::size_t to = 1; to < result.items.size(); ++to)
        for (std::size_t from = 0; from < to; ++from)
            result.pairs.push_back({from, to, result.items[to].value - result.items[from].value});
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
