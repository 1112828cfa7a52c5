#include "bench/choose/budget.h"

#include "base/arguments.h"
#include "base/error.h"

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace obscura {

namespace {

struct Limit {
    const char* name;
    const char* spelt;
    std::optional<double> Budget::*most;
    double ViewResult::*value;
};
constexpr Limit limitsOnMeans[] = {
    {"rmse", "RMSE", &Budget::rmse, &ViewResult::rmse},
    {"flip", "FLIP", &Budget::flip, &ViewResult::flip},
    {"litFlip", "FLIP of the lit image", &Budget::litFlip, &ViewResult::litFlip},
    {"flicker", "flicker", &Budget::flicker, &ViewResult::flicker},
};

double mean(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

Budget budgetOf(std::span<const std::string> limits) {
    Budget budget;
    std::vector<std::pair<const char*, std::optional<double> Budget::*>> all;
    for (const Limit& limit : limitsOnMeans)
        all.emplace_back(limit.name, limit.most);
    all.emplace_back("ms", &Budget::milliseconds);
    std::vector<std::string> names;
    names.reserve(all.size());
    for (const auto& [name, member] : all)
        names.emplace_back(name);
    for (const std::string& limit : limits) {
        const NamedNumber given = parseNamedNumber("--limit", limit, names);
        if (given.value < 0)
            throw Error(
                fmt::format("--limit: expected a number of at least 0, found \"{}\"", limit));
        const auto found = std::find(names.begin(), names.end(), given.name);
        budget.*(all[static_cast<std::size_t>(found - names.begin())].second) = given.value;
    }
    return budget;
}

double upperBound(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    if (n < 2)
        return std::numeric_limits<double>::infinity();
    const double middle = mean(values);
    double squares = 0;
    for (const double value : values)
        squares += (value - middle) * (value - middle);
    const double quantile =
        boost::math::quantile(boost::math::students_t_distribution<>(n - 1), 0.95);
    return middle + quantile * std::sqrt(squares / (n - 1) / n);
}

std::string excess(const Budget& budget, std::span<const ViewResult> views) {
    std::vector<std::pair<double, std::string>> found; // ratio to the limit, words
    for (const Limit& limit : limitsOnMeans) {
        const std::optional<double> most = budget.*limit.most;
        if (!most)
            continue;
        std::vector<double> values;
        for (const ViewResult& view : views)
            values.push_back(view.*limit.value);
        const auto unknown = std::count_if(values.begin(), values.end(),
                                           [](double value) { return !std::isfinite(value); });
        if (unknown) {
            found.emplace_back(std::numeric_limits<double>::infinity(),
                               fmt::format("{} unknown on {} of {} views, budget {:.3f}",
                                           limit.spelt, unknown, values.size(), *most));
            continue;
        }
        const double bound = upperBound(values);
        if (!(bound <= *most))
            found.emplace_back(bound / *most,
                               fmt::format("{} {:.3f} (at most {:.3f} with 95 % confidence), "
                                           "budget {:.3f}",
                                           limit.spelt, mean(values), bound, *most));
    }
    if (budget.milliseconds) {
        double dearest = 0;
        for (const ViewResult& view : views)
            dearest = std::max(dearest, view.milliseconds);
        if (dearest > *budget.milliseconds)
            found.emplace_back(
                dearest / *budget.milliseconds,
                fmt::format("{:.3g} ms in 95 of 100 frames on the dearest view, budget {:.3g}",
                            dearest, *budget.milliseconds));
    }
    std::sort(found.rbegin(), found.rend());
    std::string text;
    for (const auto& [ratio, words] : found)
        text += (text.empty() ? "" : "; ") + words;
    return text;
}

} // namespace obscura
