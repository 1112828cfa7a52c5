#pragma once

#include <span>
#include <vector>

namespace obscura {

// Ranks from 1, the smallest value first; equal values share the mean of theirs (R's rank).
struct Ranks {
    std::vector<double> ranks; // in the order of the values
    double ties = 0;           // sum of t^3 - t over groups of t equal values
};
Ranks rank(std::span<const double> values);

} // namespace obscura
