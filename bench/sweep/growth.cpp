#include "bench/sweep/growth.h"

#include <boost/math/statistics/linear_regression.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace obscura {

namespace {

bool hasLogarithms(const GrowthRow& row) {
    return row.value > 0 && row.milliseconds > 0 && std::isfinite(row.value) &&
           std::isfinite(row.milliseconds);
}

void fit(Growth& growth) {
    std::vector<double> x, y;
    for (const GrowthRow& row : growth.rows) {
        x.push_back(std::log(row.value));
        y.push_back(std::log(row.milliseconds));
    }
    growth.factor = growth.slope = growth.r2 = std::numeric_limits<double>::quiet_NaN();
    if (x.empty() || x.front() == x.back())
        return;
    const auto [intercept, slope, r2] =
        boost::math::statistics::simple_ordinary_least_squares_with_R_squared(x, y);
    growth.factor = std::exp(intercept);
    growth.slope = slope;
    growth.r2 = r2;
}

} // namespace

std::vector<Growth> growthOf(const std::vector<GrowthRow>& rows) {
    std::vector<Growth> all;
    for (const GrowthRow& row : rows) {
        if (!hasLogarithms(row))
            continue;
        auto at = std::find_if(all.begin(), all.end(), [&](const Growth& growth) {
            return growth.axis == row.axis && growth.configuration == row.configuration;
        });
        if (at == all.end())
            at = all.insert(at, {row.configuration, row.axis, {}, 0, 0, 0});
        at->rows.push_back(row);
    }
    for (Growth& growth : all) {
        std::stable_sort(growth.rows.begin(), growth.rows.end(),
                         [](const GrowthRow& a, const GrowthRow& b) { return a.value < b.value; });
        fit(growth);
    }
    return all;
}

std::vector<std::string> axesOf(const std::vector<Growth>& growth) {
    std::vector<std::string> axes;
    for (const Growth& one : growth)
        if (std::find(axes.begin(), axes.end(), one.axis) == axes.end())
            axes.push_back(one.axis);
    return axes;
}

std::string axisTitle(const std::string& axis) {
    static const std::map<std::string, std::string> titles = {
        {"samples", "value of the setting that counts samples"},
        {"radius", "radius, m"},
        {"pixels", "pixels, millions"},
        {"silhouettes", "share of pixels at a depth edge"}};
    const auto title = titles.find(axis);
    return title == titles.end() ? axis : title->second;
}

} // namespace obscura
