#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// Two prices of one thing; less is better in both.
struct ParetoPoint {
    double milliseconds = 0, error = 0;
    std::string name;
};

// One dominates another when it is nowhere dearer and somewhere cheaper. Equals do not; a point
// with a NaN neither dominates nor is dominated.
bool dominates(const ParetoPoint& one, const ParetoPoint& other);

// Indices of the points that none dominates, NaNs left out, by rising milliseconds; equals all
// stay, by name.
std::vector<std::size_t> paretoFront(std::span<const ParetoPoint> points);

// Indices of the points off the front that would be on it if each of their milliseconds were off by
// as much as `uncertainty`, a share, each way: none dominates them even when it takes
// (1 + uncertainty)^2 as long. In the front's order.
std::vector<std::size_t> nearFront(std::span<const ParetoPoint> points, double uncertainty);

// Of those that dominate it, the one with the least error (then the fastest): what to take instead.
std::optional<std::size_t> dominatedBy(std::span<const ParetoPoint> points, std::size_t index);

} // namespace obscura
