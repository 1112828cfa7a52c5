#pragma once

#include "report/axis.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// Charts of time against error and of time against a setting. As SVG for a page that styles them:
// what belongs to series i has the class "t<i>" and is drawn in currentColor, its mark is the shape
// "s<i>". As a script of gnuplot for papers, in the colours and shapes of marks.h.

struct ScatterPoint {
    std::string name;
    std::size_t series = 0;
    double milliseconds = 0, low = 0, high = 0; // median, 5th and 95th percentile; NaN: not known
    double error = 0;
};
struct Scatter {
    std::vector<ScatterPoint> points; // those without time or error are not drawn
    std::vector<std::size_t> front;   // that none dominates, by rising milliseconds
    std::vector<std::size_t> near;    // that would be there within the uncertainty of time
    std::string error;                // what it is: "RMSE, matched"
    std::string reference;            // against what: "full"
    double uncertainty = 0;           // of milliseconds, each way, as a share
};

// Milliseconds (logarithmic; what took no time stands on the left border) against the error. Each
// point is a link to its details, "#p<firstId + index>"; the front's are numbered in its order, and
// a staircase marks what it leaves dominated. Where times are uncertain, what is dominated within
// that is shaded more lightly, and reaches (1 + uncertainty)^2 as far as the staircase. Data
// attributes say what a script needs to draw the front of some of the points: of the picture the
// plot's edges, the factor and by how much it moves the edge to the right; of a mark its numbers.
std::string scatterSvg(const Scatter& scatter, std::size_t seriesCount, std::size_t firstId);

// The same for a figure of 7.2 x 4.4 inches, with a key at its right; "" where nothing has both a
// time and an error.
std::string scatterScript(const Scatter& scatter, const std::vector<std::string>& seriesNames);

// Where the numbers of a front's points are printed; a place is the middle of the number's base
// line. A number stands below and left of its point, where nothing but other such numbers can be.
// If those are too near, it stands further away, at the end of a line; if there is no room there
// either, it is left out. y points down, and a number is 12 units high.
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
    std::size_t series = 0;
    std::vector<std::pair<double, double>> points; // value, milliseconds
};
std::string growthSvg(const std::vector<GrowthLine>& lines, const std::string& axisTitle);

// Shares of a whole from left to right, in the classes "w0", "w1" ...
std::string barSvg(const std::vector<double>& shares, const std::string& description);

} // namespace obscura
