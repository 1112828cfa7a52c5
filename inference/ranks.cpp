#include "inference/ranks.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace obscura {

Ranks rank(std::span<const double> values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t one, std::size_t other) { return values[one] < values[other]; });
    Ranks result{std::vector<double>(values.size()), 0};
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        while (end < order.size() && values[order[end]] == values[order[begin]])
            ++end;
        const auto tied = static_cast<double>(end - begin);
        for (std::size_t i = begin; i < end; ++i)
            result.ranks[order[i]] = static_cast<double>(begin) + (tied + 1) / 2;
        result.ties += tied * tied * tied - tied;
    }
    return result;
}

} // namespace obscura
