#pragma once

#include "renderer/techniques/settings.h"

#include <string>

namespace obscura {

// What times are told beside, wherever techniques are timed.

// `starcraft` with 16 samples, blurred, at that radius (metres): it runs in turn with whatever is
// timed.
Settings starcraftAnchor(double radius);

// "Intel(R) Xeon(R) Processor (2 cores)"
std::string processorName();

} // namespace obscura
