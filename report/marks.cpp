#include "report/marks.h"

#include <array>

namespace obscura {

namespace {

constexpr std::array<std::string_view, 7> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                     "#E69F00", "#56B4E9", "#000000"};

struct Shape {
    std::string_view path;
    int gnuplot;
};
constexpr std::array<Shape, 8> shapes = {{
    {"M-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0 -9 0z", 7},             // circle
    {"M-4-4h8v8h-8z", 5},                                             // square
    {"M0-5.2L5 3.8H-5z", 9},                                          // triangle
    {"M0-5.6L4.6 0L0 5.6L-4.6 0z", 13},                               // diamond
    {"M0 5.2L5-3.8H-5z", 11},                                         // on its top
    {"M0-5.2L5-1.6L3.1 4.2H-3.1L-5-1.6z", 15},                        // pentagon
    {"M-1.6-5h3.2v3.4h3.4v3.2h-3.4v3.4h-3.2v-3.4h-3.4v-3.2h3.4z", 1}, // plus
    {"M-4.7-2.5l2.2-2.2l2.5 2.5l2.5-2.5l2.2 2.2l-2.5 2.5l2.5 2.5l-2.2 2.2l-2.5-2.5"
     "l-2.5 2.5l-2.2-2.2l2.5-2.5z",
     2}, // cross
}};

} // namespace

Mark markOf(std::size_t technique) {
    const Shape& shape = shapes[technique % shapes.size()];
    return {colours[technique % colours.size()], shape.path, shape.gnuplot};
}

} // namespace obscura
