#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace obscura {

// What `obscura-bench` can be asked for: a subcommand, and what it does once parsed; the program's
// exit status.
struct Command {
    CLI::App* parsed;
    std::function<int()> run;
};

std::vector<Command>
viewCommands(CLI::App& app); // rays, normals, thickness, layers, passes: one view
std::vector<Command> sweepCommands(CLI::App& app);     // sweep, merge, page, ablation: a study
std::vector<Command> chooseCommands(CLI::App& app);    // choose
std::vector<Command> stabilityCommands(CLI::App& app); // stability
std::vector<Command> statusCommands(CLI::App& app);    // status: of work that is shared

} // namespace obscura
