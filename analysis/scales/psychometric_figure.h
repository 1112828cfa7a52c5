#pragma once

#include "analysis/figures.h"
#include "analysis/scales/scale_kinds.h"
#include "analysis/scales/scale_panels.h"

#include <string>

namespace obscura {

// Of each ladder its shares, the fitted curve and the threshold; every result has a curve.
StudyFigure psychometricFigure(const ScaleKind& kind, const ScaleResults& results,
                               const std::string& name, const std::string& stamp);

} // namespace obscura
