#pragma once

#include "base/progress.h"
#include "bench/sweep/sweep.h"
#include "protocols/reader/sweep.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What the commands that measure a study have in common on their command lines: sweep and choose.

struct StudyOptions {
    std::filesystem::path study, out, scenes;
    std::string device, part, measure = "both";
    std::vector<std::string> sizes, display;
    double seconds = -1, hours = 1;
    bool quick = false;
};

void addStudyOptions(CLI::App& command, StudyOptions& options);

// Applies --quick (with so many test views), --size, --seconds and --display.
void adjust(SweepStudy& study, const StudyOptions& options, std::size_t quickViews);

// An Error says what is wrong with --part.
SweepPlan planOf(const StudyOptions& options, const std::filesystem::path& folder);

// A line that appears with the first report, on which the total is known.
class Reporting {
  public:
    explicit Reporting(std::string label) : label_(std::move(label)) {}
    SweepProgress progress() {
        return [this](double done, double total, const std::string& note) {
            if (!line_ || total != total_)
                line_.emplace(label_, total_ = total);
            line_->update(done, note);
        };
    }
    void end() { line_.reset(); }

  private:
    std::string label_;
    double total_ = 0;
    std::optional<Progress> line_;
};

} // namespace obscura
