#include "inference/robust.h"

#include "base/percentile.h"

#include "inference/result.h"
#include "inference/sums.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

using Values = std::vector<double>;

Values copyOf(std::span<const double> values) { return {values.begin(), values.end()}; }

double deviation(std::span<const double> values) { // at least two
    return std::sqrt(sumOfSquares(values, mean(values)) / static_cast<double>(values.size() - 1));
}

double medianDistance(std::span<const double> values, double median) {
    Values distances;
    for (const double value : values)
        distances.push_back(std::abs(value - median));
    return 1.4826 * percentile(std::move(distances), 0.5);
}

double trimmed(std::span<const double> values) {
    Values sorted = copyOf(values);
    const auto cut = static_cast<std::size_t>(0.1 * static_cast<double>(sorted.size()));
    const auto low = sorted.begin() + static_cast<std::ptrdiff_t>(cut);
    const auto high = sorted.end() - static_cast<std::ptrdiff_t>(cut);
    std::nth_element(sorted.begin(), low, sorted.end());
    if (cut > 0)
        std::nth_element(low, high, sorted.end());
    return mean(std::span(sorted).subspan(cut, sorted.size() - 2 * cut));
}

// What lies outside is flagged. Without spread (one value) nothing is.
Interval around(double centre, double reach) { return {centre - reach, centre + reach}; }

Interval accepted(std::span<const double> values, FlagRule rule) {
    switch (rule) {
    case FlagRule::fast:
        return {200, values.empty() ? 200 : *std::max_element(values.begin(), values.end())};
    case FlagRule::sd:
    case FlagRule::sdLog:
        return around(mean(values), values.size() > 1 ? 3 * deviation(values) : 0);
    case FlagRule::mad:
    case FlagRule::madLog: {
        const double median = percentile(copyOf(values), 0.5);
        return around(median, 2.5 * medianDistance(values, median));
    }
    case FlagRule::tukey:
        break;
    }
    const Values quartiles = quantiles(values, Values{0.25, 0.75});
    const double reach = 1.5 * (quartiles[1] - quartiles[0]);
    return {quartiles[0] - reach, quartiles[1] + reach};
}

} // namespace

std::optional<Summary> summary(std::span<const double> values) {
    checkFinite(values);
    if (values.empty())
        return std::nullopt;
    Summary result{.count = values.size(), .mean = mean(values), .sd = {}, .geometricMean = {}};
    if (values.size() > 1)
        result.sd = deviation(values);
    result.median = percentile(copyOf(values), 0.5);
    result.mad = medianDistance(values, result.median);
    result.trimmedMean = trimmed(values);
    if (std::all_of(values.begin(), values.end(), [](double value) { return value > 0; })) {
        double logs = 0;
        for (const double value : values)
            logs += std::log(value);
        result.geometricMean = std::exp(logs / static_cast<double>(values.size()));
    }
    return result;
}

std::vector<double> quantiles(std::span<const double> values, std::span<const double> shares) {
    checkFinite(values);
    if (values.empty())
        return {};
    if (std::is_sorted(shares.begin(), shares.end()))
        return percentiles(copyOf(values), shares);
    Values result;
    for (const double share : shares)
        result.push_back(percentile(copyOf(values), share));
    return result;
}

std::vector<bool> flags(std::span<const double> values, FlagRule rule) {
    checkFinite(values);
    const bool isLog = rule == FlagRule::sdLog || rule == FlagRule::madLog;
    Values scaled; // what the rule goes by
    for (const double value : values)
        if (!isLog || value > 0)
            scaled.push_back(isLog ? std::log(value) : value);
    std::vector<bool> result(values.size(), isLog);
    if (scaled.empty())
        return result;
    const Interval within = accepted(scaled, rule);
    std::size_t next = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!isLog || values[i] > 0) {
            const double value = scaled[next++];
            result[i] = value < within.low || value > within.high;
        }
    return result;
}

} // namespace obscura
