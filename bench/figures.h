#pragma once

#include "bench/sweep_row.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// The page's charts for papers, by gnuplot: how time and matched RMSE trade in each scene and
// resolution, what the extensions of VAO++ save, how cost grows.
struct Figure {
    std::string name;             // of its files
    std::string title;            // accessible name
    std::string script;           // complete but for its terminal
    double width = 0, height = 0; // inches
};
std::vector<Figure> sweepFigures(const Sweep& sweep);

// NAME.svg, NAME.pdf and NAME.gnuplot, to be changed and run again:
// gnuplot -e "set terminal pdfcairo; set output 'NAME.pdf'" NAME.gnuplot
void writeFigures(const std::filesystem::path& folder, const std::vector<Figure>& figures);

} // namespace obscura
