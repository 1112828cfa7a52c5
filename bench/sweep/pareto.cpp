#include "bench/sweep/pareto.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace obscura {

namespace {

// Points that none dominates even when it takes `factor` times as long.
std::vector<std::size_t> undominated(std::span<const ParetoPoint> points, double factor) {
    const auto key = [&](std::size_t i) {
        return std::tie(points[i].milliseconds, points[i].error, points[i].name);
    };
    const auto isBeaten = [&](const ParetoPoint& point) {
        return std::any_of(points.begin(), points.end(), [&](const ParetoPoint& other) {
            return dominates({other.milliseconds * factor, other.error, {}}, point);
        });
    };
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!std::isnan(points[i].milliseconds + points[i].error) && !isBeaten(points[i]))
            left.push_back(i);
    std::sort(left.begin(), left.end(), [&](auto a, auto b) { return key(a) < key(b); });
    return left;
}

} // namespace

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
    return undominated(points, 1);
}

std::vector<std::size_t> nearFront(std::span<const ParetoPoint> points, double uncertainty) {
    const std::vector<std::size_t> front = paretoFront(points);
    std::vector<std::size_t> near = undominated(points, std::pow(1 + uncertainty, 2));
    std::erase_if(near, [&](std::size_t i) {
        return std::find(front.begin(), front.end(), i) != front.end();
    });
    return near;
}

} // namespace obscura
