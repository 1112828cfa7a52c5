#pragma once

#include <cstddef>
#include <string_view>

namespace obscura {

// How a technique looks in every chart: by its place among the sweep's, 56 places differ in colour
// (Okabe and Ito 2008, without yellow, which white paper swallows) or shape.
struct Mark {
    std::string_view colour; // "#0072B2"
    std::string_view path;   // of SVG, filled, within 5 units of the origin
    int gnuplot;             // its point type of the same shape
};
Mark markOf(std::size_t technique);

} // namespace obscura
