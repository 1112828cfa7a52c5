#pragma once

#include "analysis/figures.h"
#include "analysis/scales/scale_panels.h"

#include <string>

namespace obscura {

// How often each rating was given, by technique; items have counts.
StudyFigure ratingFigure(const ScaleResults& results, const std::string& name,
                         const std::string& stamp);

} // namespace obscura
