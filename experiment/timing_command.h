#pragma once

#include "experiment/display.h"

#include <filesystem>

namespace obscura {

// Holds masks on a display and says how long they were: on stdout as a table or as JSON, and, where
// `out` is a folder, in timing.json and masks.csv. The program's exit status.
int runTiming(const DisplayOptions& options, int masks, double seconds, bool json,
              const std::filesystem::path& out);

} // namespace obscura
