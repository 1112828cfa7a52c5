#pragma once

#include "report/axis.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// Charts for papers, by gnuplot.
struct Figure {
    std::string name;             // of its files
    std::string title;            // accessible name
    std::string script;           // complete but for its terminal
    double width = 0, height = 0; // inches
};

// NAME.svg, NAME.pdf and NAME.gnuplot, to be changed and run again:
// gnuplot -e "set terminal pdfcairo; set output 'NAME.pdf'" NAME.gnuplot
void writeFigures(const std::filesystem::path& folder, const std::vector<Figure>& figures);

// The figure as a part of a page, so many pixels wide and high, with type of 13 pixels where the
// script sets none. It is an image to assistive technology, named by the title; what its elements
// are called (ids) begins with `prefix`, for a page may hold several.
std::string pageSvg(const Figure& figure, int width, int height, const std::string& prefix);

// Pieces of the figures' scripts.
namespace plot {

// What all figures begin with: borders, grid and key.
extern const char* const style;

// An axis ("x" or "y") with its range, scale and ticks.
std::string ticks(const char* axis, const Axis& range);
// A block of data, "$name", of lines that end in line breaks.
std::string block(const std::string& name, const std::string& lines);
// The mark of a series (marks.h).
std::string pointStyle(std::size_t series);
// What one plot command draws, each on a line of its own.
std::string list(const std::vector<std::string>& elements);

} // namespace plot

} // namespace obscura
