#include "base/percentile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace obscura {

double percentile(std::vector<double> values, double share) {
    return percentiles(std::move(values), {&share, 1}).front();
}

std::vector<double> percentiles(std::vector<double> values, std::span<const double> shares) {
    assert(std::is_sorted(shares.begin(), shares.end()));
    std::vector<double> result(shares.size(), std::numeric_limits<double>::quiet_NaN());
    if (values.empty() ||
        std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }))
        return result;
    auto first = values.begin(); // what is before it is no greater than what is from it on
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const double rank = shares[i] * static_cast<double>(values.size() - 1);
        const auto below = values.begin() + static_cast<std::ptrdiff_t>(rank);
        std::nth_element(first, below, values.end());
        first = below;
        result[i] = *below;
        if (below + 1 != values.end())
            result[i] = std::lerp(*below, *std::min_element(below + 1, values.end()),
                                  rank - std::floor(rank));
    }
    return result;
}

} // namespace obscura
