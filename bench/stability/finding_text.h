#pragma once

#include "bench/motion/temporal.h"

#include <string>

namespace obscura {

// What a unit of the stability tests finds, as its result, and back: every number exactly, with
// those that are none. A text that is no such result is an Error.
std::string findingText(const TemporalFinding& finding);
TemporalFinding readFinding(const std::string& text);

} // namespace obscura
