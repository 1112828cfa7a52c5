#pragma once

#include "bench/sweep/summary.h"

#include <string>
#include <vector>

namespace obscura {

// Frame rates at default settings, as in Table 1 of the thesis from Leeds: one per group.
struct FrameRates {
    struct Line { // one technique; NaN for a view without it
        std::string technique;
        // G-buffer (the view's median) and technique, without lighting; per view
        std::vector<double> milliseconds;
    };
    std::string title;              // of the group
    std::vector<std::string> views; // at most four
    std::vector<Line> lines;
};
std::vector<FrameRates> frameRates(const std::vector<SweepRow>& rows);

// All settings but the radius, which is the scene's, are what the technique's table says.
bool hasDefaultSettings(const SweepRow& row);

} // namespace obscura
