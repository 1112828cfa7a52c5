#pragma once

#include "protocols/reader/protocol.h"

#include <string>

namespace obscura {

// Proves that a study can be run to its end on a screen of that size: every page and every set of
// images fits, every character can be shown, and in each slot of the plan a simulated participant
// finishes every trial. An Error says what cannot; else what was tried, in a line.
std::string checkRuns(const Protocol& protocol, int width, int height);

} // namespace obscura
