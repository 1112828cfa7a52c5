#pragma once

#include "analysis/scales/panels.h"
#include "analysis/scales/scale_result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace obscura {

// What panels of scales have in common.

using ScaleResults = std::vector<const ScaleResult*>; // a panel each

inline constexpr const char* scaleGrey = "#777777";

// "atrium, sky" or "all scenes and levels".
std::string panelTitle(const ScaleGroup& group);

// A round step so that the range has some four to seven ticks.
double tickStep(double range);

// As they first come.
std::vector<std::string> techniquesOf(const ScaleResults& results);

// Inches left of a plot, for such names.
double nameWidth(const std::vector<std::string>& names);

// A row for each item, in this order: the height of the plot in inches, and its vertical axis.
double heightOf(const std::vector<std::size_t>& order);
std::string rowTicks(const ScaleResult& result, const std::vector<std::size_t>& order);

} // namespace obscura
