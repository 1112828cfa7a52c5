#pragma once

#include <string>

namespace obscura {

// A number as people read it: so many significant digits (more before the point if need be), never
// an exponent, a real minus sign, "–" for NaN.
std::string readable(double value, int digits = 3);

} // namespace obscura
