#pragma once

#include "analysis/findings.h"
#include "analysis/table.h"
#include "report/paper_figure.h"

#include <string>
#include <vector>

namespace obscura {

// What readers look at: each stands in the report with its numbers as a table below it, and is
// written as SVG and PDF for papers.
struct StudyFigure {
    Figure drawing;
    std::string caption; // what is seen, and what its marks mean
    Table numbers;       // all that is drawn
};

// Those that the findings give reason for, in the order of the page. Simulated data are marked
// within each picture, which may travel without its page.
std::vector<StudyFigure> figuresOf(const Findings& findings);

} // namespace obscura
