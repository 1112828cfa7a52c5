#pragma once

#include "bench/sweep_summary.h"

#include <array>

namespace obscura {

// The tables of two papers, filled with what a sweep measured.

// What the extensions of VAO++ save, as in its Table 1, and at what error: by number of samples
// (lines), resolution and variant, with all other settings equal. NaN: not measured.
struct AblationTable {
    struct Column { // one resolution
        std::string title;
        // By sample count, then plain, adaptive, culling, both.
        std::array<std::array<double, 4>, 5> milliseconds;
        std::array<std::array<double, 4>, 5> rmse; // matched, full reference; none as printed
        std::array<double, 5> vao{}; // milliseconds of `vao`, its cheapest with as many lines; none
                                     // as printed
    };
    std::string scene, settings; // the settings that are equal in every cell
    std::vector<Column> columns;
};
inline constexpr std::array<int, 5> ablationSamples = {2, 4, 8, 16, 32};
inline constexpr std::array<const char*, 4> ablationVariants = {"plain", "adaptive", "culling",
                                                                "both"};

// One for each scene, choice of the other settings and kind of culling that was measured in more
// than one variant; from rows of `vao_plus_plus`.
std::vector<AblationTable> ablationTables(const std::vector<SweepGroup>& groups);

// As printed: Bokšanský, Pospíšil and Bittner 2017, Table 1, on a GTX 970.
const AblationTable& publishedAblation();

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
