#pragma once

#include <span>

namespace obscura {

double mean(std::span<const double> values); // of at least one
// Sum of (value - centre)^2.
double sumOfSquares(std::span<const double> values, double centre);

// An Error that names the first value that is NaN or infinite.
void checkFinite(std::span<const double> values);

} // namespace obscura
