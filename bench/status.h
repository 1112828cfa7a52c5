#pragma once

#include "base/units.h"

#include <filesystem>
#include <string>

namespace obscura {

// How far work that processes share in a folder is, over all of them: `obscura-bench status`.

// "340 of 600 units, 57 % of the work; 4 processes, about 8 min left", on one line.
std::string progressText(const UnitsState& state);

// The same, then a line for each unit that is held (by whom, since when) or whose process is gone.
std::string statusText(const UnitsState& state);

} // namespace obscura
