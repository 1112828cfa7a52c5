#pragma once

#include "bench/axis.h"
#include "bench/sweep_summary.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// Charts of sweep.html, as SVG that the page styles: what belongs to technique i has the class
// "t<i>" and is drawn in currentColor, its mark is the shape "s<i>".

// Milliseconds (logarithmic; what took no time stands on the left border) against an error. Each
// configuration is a link to its details, "#p<firstId + index>"; the front's are numbered in its
// order, and a staircase marks what it leaves dominated.
std::string scatterSvg(const SweepGroup& group, const ErrorMeasure& measure,
                       const std::vector<std::string>& techniques, std::size_t firstId);

// Where the numbers of a front's points stand, centred on their base lines: below and left of each,
// where nothing can be but other such numbers; further away, at the end of a line, where those are
// near; nowhere when they are everywhere. y points down, and a number is 12 units high.
struct Spot {
    double x = 0, y = 0;
};
struct NumberPlace {
    double x = 0, y = 0;
    bool far = false;
};
std::vector<std::optional<NumberPlace>> numberPlaces(const std::vector<Spot>& spots, double left,
                                                     double bottom);

// How milliseconds grow along one axis, both logarithmic: a line for each configuration.
struct GrowthLine {
    std::string title;
    std::size_t technique = 0;
    std::vector<std::pair<double, double>> points; // value, milliseconds
};
std::string growthSvg(const std::vector<GrowthLine>& lines, const std::string& axisTitle);

// Shares of a whole from left to right, in the classes "w0", "w1" ...
std::string barSvg(const std::vector<double>& shares, const std::string& description);

} // namespace obscura
