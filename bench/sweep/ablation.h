#pragma once

#include "bench/sweep/summary.h"
#include "report/paper_figure.h"

#include <array>
#include <string>
#include <vector>

namespace obscura {

// What the extensions of VAO++ save, and at what error, as in Table 1 of Bokšanský, Pospíšil and
// Bittner 2017. `obscura-bench ablation` makes these tables of a sweep of
// protocols/sweep-vao-plus-plus.toml.

// By number of samples (lines), resolution and variant, with all other settings equal. NaN: not
// measured.
struct AblationTable {
    struct Column { // one resolution
        std::string title;
        // By sample count, then plain, adaptive, culling, both.
        std::array<std::array<double, 4>, 5> milliseconds;
        std::array<std::array<double, 4>, 5> rmse; // matched, full reference
        std::array<double, 5> vao{}; // milliseconds of `vao`, its cheapest with as many lines
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

// One line per cell: scene, settings, resolution, samples, variant, milliseconds, per cent of
// plain, matched RMSE; the paper's own cells have the scene "GTX 970 (paper)".
std::string ablationCsv(const std::vector<AblationTable>& tables);

// The table as text of fixed width.
std::string ablationText(const AblationTable& table);

// A column for each resolution: above milliseconds, below per cent of plain, the paper's at 1080p
// in grey. Columns without times are left out; of none, no script.
Figure ablationFigure(const AblationTable& table, std::size_t number);

} // namespace obscura
