#pragma once

#include <string>
#include <vector>

namespace obscura {

// A figure of panels in two columns, each with its names at the left. Inches.
struct Panel {
    std::string title;
    std::string script; // its labels, ranges and plot command
    double height = 1;  // of the plot itself
};
struct PanelLayout {
    double nameWidth = 0.8;  // left of each plot
    double rightWidth = 0.2; // right of each plot
    double below = 0.46;     // for ticks and the axis' title
    double header = 0;       // above all panels
};

struct PanelFigure {
    std::string script;
    double width = 7.2, height = 0;
};
// `blocks`: what panels plot, and `begin` what holds for all of them. `stamp` stands above all, at
// the right; "" for none.
PanelFigure panelFigure(const std::string& blocks, const std::string& begin,
                        const std::vector<Panel>& panels, PanelLayout layout,
                        const std::string& stamp);

// How wide a text of so many characters is, in inches, at 8 points.
double textWidth(const std::string& text);

} // namespace obscura
