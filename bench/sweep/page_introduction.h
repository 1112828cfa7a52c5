#pragma once

#include "bench/sweep/row.h"

#include <string>

namespace obscura {

// What sweep.html says before its charts, as HTML: what was measured on what, what is missing, and
// how to read what is drawn.
std::string sweepIntroduction(const Sweep& sweep);

} // namespace obscura
