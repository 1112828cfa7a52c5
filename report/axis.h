#pragma once

#include <span>
#include <string>
#include <vector>

namespace obscura {

struct Tick {
    double value = 0;
    std::string label; // "" for a small one
};

// One axis of a chart: a range that holds all values, and where it is marked.
struct Axis {
    double low = 0, high = 1;
    bool logarithmic = false;
    std::vector<Tick> ticks;

    // 0 at its low end, 1 at its high end. A logarithm that does not exist is at the low end.
    double at(double value) const;
};

// Ticks at 1, 2 and 5 times powers of ten, and small ones between; over many decades fewer. Values
// without a logarithm, and NaNs, do not count.
Axis logarithmicAxis(std::span<const double> values);

// The same with a tick at each value instead, where these are few and leave room for their labels.
Axis valueAxis(std::span<const double> values);

// From 0; NaNs do not count.
Axis linearAxis(std::span<const double> values);

} // namespace obscura
