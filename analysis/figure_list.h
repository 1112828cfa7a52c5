#pragma once

#include "analysis/figures.h"

#include <vector>

namespace obscura {

// The figures that the findings give reason for, in the order of the page. Simulated data are
// marked within each picture, which may travel without its page.
std::vector<StudyFigure> figuresOf(const Findings& findings);

} // namespace obscura
