#include "bench/sweep/pareto.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace obscura {

bool dominates(const ParetoPoint& one, const ParetoPoint& other) {
    return one.milliseconds <= other.milliseconds && one.error <= other.error &&
           (one.milliseconds < other.milliseconds || one.error < other.error);
}

std::optional<std::size_t> dominatedBy(std::span<const ParetoPoint> points, std::size_t index) {
    const auto key = [&](std::size_t i) {
        return std::tie(points[i].error, points[i].milliseconds, points[i].name);
    };
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (dominates(points[i], points[index]) && (!best || key(i) < key(*best)))
            best = i;
    return best;
}

std::vector<std::size_t> paretoFront(std::span<const ParetoPoint> points) {
    const auto key = [&](std::size_t i) {
        return std::tie(points[i].milliseconds, points[i].error, points[i].name);
    };
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!std::isnan(points[i].milliseconds + points[i].error) && !dominatedBy(points, i))
            front.push_back(i);
    std::sort(front.begin(), front.end(), [&](auto a, auto b) { return key(a) < key(b); });
    return front;
}

} // namespace obscura
