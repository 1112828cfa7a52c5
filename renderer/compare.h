#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace obscura {

// `obscura-render compare TEST REFERENCE`: how far apart two pictures are by every metric, and maps
// of where. Adds the command to `app`; the result runs it and gives the program's exit status.
std::function<int()> addCompare(CLI::App& app);

} // namespace obscura
