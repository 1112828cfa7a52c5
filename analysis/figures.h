#pragma once

#include "analysis/findings.h"
#include "analysis/table.h"
#include "report/paper_figure.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What readers look at: each stands in the report, its numbers in a table further down, and is
// written as SVG and PDF for papers.
struct StudyFigure {
    Figure drawing;
    std::string caption; // what is seen, and what its marks mean
    Table numbers;       // all that is drawn
    // For a page as narrow as a hand, where the drawing's own arrangement has no room: its width is
    // `narrowFigure`. Absent: the drawing, drawn at that width.
    std::optional<Figure> narrow = std::nullopt;
};

// Inches: across a page, and one column of it.
constexpr double wideFigure = 760 / 96.0, narrowFigure = 340 / 96.0;

// As part of a figure's script: that its data are simulated, large and pale behind everything, in a
// picture of so many inches; "" for data of people.
std::string stampScript(const Findings& findings, double width, double height);

// Members of figuresOf(), analysis/figure_list.h.
std::vector<StudyFigure> sharesFigures(const Findings& findings);
std::vector<StudyFigure> powerFigures(const Findings& findings);
std::vector<StudyFigure> flowFigures(const Findings& findings);
std::vector<StudyFigure> timingFigures(const Findings& findings);

} // namespace obscura
