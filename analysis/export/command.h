#pragma once

#include "analysis/answers.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace obscura {

struct ExportOptions {
    std::filesystem::path study, out, stimuli, key;
    std::string format;
    SimulatedRows simulated = SimulatedRows::refuse;
    bool lenient = false;
};

// `obscura-analysis export`: declares the command and what it takes.
CLI::App* declareExport(CLI::App& app, ExportOptions& options);

// Writes the study's data into a new folder, whole or not at all, and says what it left out.
// Nothing that was there before is changed: an Error where `out` is a file, or a folder with
// something in it.
void exportStudy(const ExportOptions& options);

} // namespace obscura
