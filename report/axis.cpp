#include "report/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace obscura {

namespace {

constexpr double beyond = 1.15; // beyond the outermost values of a logarithmic axis
constexpr double step = 1e-9;   // what rounding may do to a tick at the very end

// At most this many decades have their 2 and 5 (and, fewer, all nine) labelled.
constexpr double allLabelled = 0.7, twoAndFive = 3.5;

bool labelled(int digit, double decades) {
    return digit == 1 || decades < allLabelled ||
           ((digit == 2 || digit == 5) && decades < twoAndFive);
}

std::vector<Tick> logarithmicTicks(double low, double high) {
    std::vector<Tick> ticks;
    const double decades = std::log10(high / low);
    for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10, power) <= high;
         ++power)
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * std::pow(10, power);
            if (value >= low && value <= high)
                ticks.push_back(
                    {value, labelled(digit, decades) ? fmt::format("{:g}", value) : ""});
        }
    return ticks;
}

} // namespace

double Axis::at(double value) const {
    if (!logarithmic)
        return (value - low) / (high - low);
    return value > 0 ? std::log(value / low) / std::log(high / low) : 0;
}

Axis logarithmicAxis(std::span<const double> values) {
    double low = HUGE_VAL, high = 0;
    for (const double value : values)
        if (value > 0 && std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    if (high == 0)
        low = high = 1;
    Axis axis{low / beyond, high * beyond, true, {}};
    axis.ticks = logarithmicTicks(axis.low, axis.high);
    return axis;
}

Axis valueAxis(std::span<const double> values) {
    Axis axis = logarithmicAxis(values);
    const std::set<double> distinct(values.begin(), values.end());
    std::vector<Tick> ticks;
    for (const double value : distinct) {
        if (ticks.size() == 8 || (!ticks.empty() && value < 1.3 * ticks.back().value))
            return axis;
        ticks.push_back({value, fmt::format("{:.3g}", value)});
    }
    axis.ticks = ticks;
    return axis;
}

Axis linearAxis(std::span<const double> values) {
    double highest = 0;
    for (const double value : values)
        if (std::isfinite(value))
            highest = std::max(highest, value);
    if (highest == 0)
        highest = 1;
    // About five ticks: the roundest of 1, 2, 5 times a power of ten.
    const double power = std::pow(10, std::floor(std::log10(highest / 4)));
    double spacing = power;
    for (const double factor : {2.0, 5.0, 10.0})
        if (highest / spacing > 6)
            spacing = factor * power;
    Axis axis{0, highest * 1.05, false, {}};
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(spacing) + step)));
    for (int i = 0; i * spacing <= axis.high; ++i)
        axis.ticks.push_back({i * spacing, fmt::format("{:.{}f}", i * spacing, decimals)});
    return axis;
}

} // namespace obscura
