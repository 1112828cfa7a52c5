#include "base/percentile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace obscura {

double percentile(std::vector<double> values, double share) {
    if (values.empty() ||
        std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }))
        return std::numeric_limits<double>::quiet_NaN();
    const double rank = share * static_cast<double>(values.size() - 1);
    const auto below = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), below, values.end());
    if (below + 1 == values.end())
        return *below;
    const double next = *std::min_element(below + 1, values.end());
    return std::lerp(*below, next, rank - std::floor(rank));
}

} // namespace obscura
