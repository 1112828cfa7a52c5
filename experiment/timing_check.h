#pragma once

#include "experiment/refresh.h"
#include "gl/window.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What the start-up check found out about a display.
struct DisplayCheck {
    IntervalSummary flips;           // of the intervals that its rate was taken from
    std::string unsynchronised;      // why swaps seem to follow no vertical blank; "" if they do
    int reportedHz = 0;              // of the monitor's mode
    std::optional<int> queued;       // swaps that it takes ahead of the screen; nothing: not known
    std::optional<bool> compositor;  // whether one runs; nothing: not known
    double contentScale = 1;         // 1 is 100 %
    std::array<int, 3> colourBits{}; // of red, green and blue
    std::optional<bool> variable;    // whether the driver had asked for a varying rate
};

// Swaps that a display takes ahead of the screen: those that return at once before the first one
// that waits, after a pause in which all earlier ones have been shown. 0 is double buffering, 1
// triple. Nothing when none waits.
std::optional<int> queuedSwaps(const std::vector<double>& intervalsAfterPause, double hz);

// Whether the display's own stamps of vertical blanks can be believed: each swap must have come on
// at a later blank, and in the time that those blanks take at the rate that the system reports
// (within a twentieth), and not later than it was asked (`now`, after each).
bool plausible(const std::vector<gl::Onset>& onsets, const std::vector<double>& now,
               int reportedHz);

// Why no data should be collected on such a display, and what to do about it; "" if they may.
std::string objectionTo(const DisplayCheck& check);

// For the session file, and in a line for the experimenter.
nlohmann::ordered_json spell(const DisplayCheck& check);
std::string inWords(const DisplayCheck& check);

} // namespace obscura
