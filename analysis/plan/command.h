#pragma once

#include "analysis/plan/plan.h"

#include <CLI/CLI.hpp>

#include <filesystem>

namespace obscura {

struct PlanCommand {
    std::filesystem::path protocol, stimuli, out = "plan";
    std::string observer = "preference"; // or "jod"
    PlanOptions options;
};

// `obscura-analysis plan`: declares the command and what it takes.
CLI::App* declarePlan(CLI::App& app, PlanCommand& command);

// Prints the plan, and writes preregistration.md and the figure power.svg (and PDF, and gnuplot).
void planStudy(const PlanCommand& command);

} // namespace obscura
