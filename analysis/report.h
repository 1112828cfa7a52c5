#pragma once

#include "analysis/findings.h"

#include <string>

namespace obscura {

// One HTML page with everything in it, chart and pictures too: it needs no network and no other
// file, and prints. It is well-formed XML as well, so that programs can read it.
std::string reportHtml(const Findings& findings);

} // namespace obscura
