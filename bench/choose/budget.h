#pragma once

#include "bench/sweep/row.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// What is good enough, and whether a configuration is; all functions are pure.

// The limits: the most that each measure may be. A measure without a limit does not matter.
struct Budget {
    std::optional<double> rmse;         // of matched visibility, 0 ... 1
    std::optional<double> flip;         // of matched visibility shown as sRGB grey
    std::optional<double> litFlip;      // of the lit image
    std::optional<double> flicker;      // 99th percentile of reference-relative change, worst path
    std::optional<double> milliseconds; // in 95 of 100 frames, on the dearest view
    std::vector<std::string> failures;  // ids of failure tests that must pass
};

// "rmse=0.1" and the like, as the command line has them; an Error lists the names.
Budget budgetOf(std::span<const std::string> limits);

// What a configuration gave on one held-out view.
struct ViewResult {
    double rmse = 0, flip = 0, litFlip = 0; // NaN: not measured
    double milliseconds = 0;                // 95th percentile
    double flicker = 0;                     // as in Budget
};

// The upper end of the one-sided 95 % confidence interval of a mean over views (Student's t; views
// are the sample). One value alone bounds nothing: infinity.
double upperBound(std::span<const double> values);

// Why the results do not meet the budget, the worst excess first: "RMSE 0.132 (at most 0.135 with
// 95 % confidence), budget 0.100"; "" when they do.
std::string excess(const Budget& budget, std::span<const ViewResult> views);

} // namespace obscura
