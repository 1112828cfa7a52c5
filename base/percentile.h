#pragma once

#include <span>
#include <vector>

namespace obscura {

// The value below which `share` (0 to 1) of the values lie, interpolated linearly between the two
// nearest (Hyndman and Fan 1996, type 7: the default of R and NumPy); 0.5 gives the median. NaN
// without values, and where one of them is NaN.
double percentile(std::vector<double> values, double share);

// Of several ascending shares, at little more than the cost of one.
std::vector<double> percentiles(std::vector<double> values, std::span<const double> shares);

} // namespace obscura
