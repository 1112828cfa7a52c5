#pragma once

#include "analysis/scales/scale_kinds.h"

#include <string>
#include <vector>

namespace obscura {

// The report's section with every scale and what is to be known of it; "" without any.
std::string scalesSection(const std::vector<Scaled>& scales);

} // namespace obscura
