#pragma once

#include "analysis/figures.h"

#include <vector>

namespace obscura {

// Of each question and leading kind of scale one figure: the techniques with their intervals and
// the steps between neighbours, or a psychometric function; of ratings also how often each was
// given. A panel for each scene and level.
std::vector<StudyFigure> scaleFigures(const Findings& findings);

} // namespace obscura
