#pragma once

#include "analysis/figures.h"

#include <vector>

namespace obscura {

// How many people chose the second picture how often, against what chance alone would give.
std::vector<StudyFigure> positionFigures(const Findings& findings);

// How long people looked and took to answer.
std::vector<StudyFigure> timesFigures(const Findings& findings);

} // namespace obscura
