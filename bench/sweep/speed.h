#pragma once

#include "bench/sweep/row.h"

#include <span>

namespace obscura {

// How fast the machine was while a sweep was measured. Groups of configurations run one after the
// other, while machines heat up and others use them; `starcraft` with 16 samples, the anchor, runs
// in every round of every group.

// The rows with their milliseconds as at the view's typical speed: each row's are scaled so that
// the anchor takes in its rounds what it takes in the view's median row. Ratios stay as they are;
// so does what has none.
std::vector<SweepRow> atTypicalSpeed(std::vector<SweepRow> rows);

// How far the anchor's time strays, of rows as they were measured. A row strays by how far the
// anchor's time in its rounds is from that of the view's median row, or by how far its odd rounds
// are from its even ones, whichever is more; 0 without an anchor.
struct Straying {
    double mean =
        0; // over the rows, as a share of time: scaled times are trusted to this, each way
    double most = 0;                 // of a row
    std::string view;                // of that row
    double fastest = 1, slowest = 1; // the anchor's time over its typical time, least and most
    double repeat = 0;               // most that odd rounds differ from even ones

    // More than one in twenty: what is this near in time is not told apart.
    bool isTooMuch() const { return most > 0.05; }
};
Straying strayingOf(std::span<const SweepRow> rows);

// "The machine was busy: ...", what a page says above a chart; "" where it strays little.
std::string warningOf(const Straying& straying);

} // namespace obscura
