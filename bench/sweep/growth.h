#pragma once

#include "bench/sweep/row.h"

namespace obscura {

// How one configuration's time grows along one axis: milliseconds = factor value^slope, fitted by
// least squares to the logarithms. Rows of which a logarithm does not exist are left out.
struct Growth {
    std::string configuration, axis;
    std::vector<GrowthRow> rows;          // by rising value
    double factor = 0, slope = 0, r2 = 0; // NaN with fewer than two different values
};

// In the order of the axes' and configurations' first appearance.
std::vector<Growth> growthOf(const std::vector<GrowthRow>& rows);

// Axes in that order.
std::vector<std::string> axesOf(const std::vector<Growth>& growth);

// "samples per pixel", "radius, m" ...; the name itself of an axis it does not know.
std::string axisTitle(const std::string& axis);

} // namespace obscura
