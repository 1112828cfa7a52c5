#pragma once

#include <cstddef>
#include <string_view>

namespace obscura {

// How a technique looks in every chart. It follows from the technique's place among those of the
// sweep: 56 places differ in colour (Okabe and Ito 2008, without yellow, which cannot be seen on
// white paper) or in shape.
struct Mark {
    std::string_view colour; // "#0072B2"
    std::string_view path;   // of SVG, filled, within 5 units of the origin
    int gnuplot;             // its point type of the same shape
};
Mark markOf(std::size_t technique);

} // namespace obscura
