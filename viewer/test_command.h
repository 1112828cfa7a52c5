#pragma once

#include "viewer/command_line.h"
#include "viewer/test_results.h"

namespace obscura {

// The plan that a command line asks for. Cameras are those of its protocol, else the one that it
// names, else those that were stored in the window (presets.h), else the file's own where it has
// two or more, else such as are found in the scene.
TestPlan testPlanOf(const CommandLine& line);

// obscura-view --test: progress to stderr, the table to stdout. Gives the exit status.
int runTestCommand(const CommandLine& line);

} // namespace obscura
