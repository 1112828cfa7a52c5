#pragma once

#include <string>
#include <vector>

namespace obscura {

// How often the display shows a new picture, and whether that can be relied on.
struct Refresh {
    double hz = 60;
    std::string source = "none"; // as the column timestamp_source: finish, or none (untimed)
    std::string doubt;           // why it is untimed; "" otherwise
};

// What intervals between swaps (seconds) say. They are believed when they agree with each other
// (nine in ten within a fifth of their median) and with the rate the system reports (within a
// twentieth; systems round it). Swaps that return at once, as without a screen, fail on one or
// both. An untimed display is paced by the clock at 60 Hz.
Refresh judgeRefresh(std::vector<double> intervals, int reportedHz);

// Whole refreshes that a mask of that length takes, rounded up unless it would end within a quarter
// of a refresh: 2 s are 120 at 59.94, 59.951 and 60 Hz.
int maskRefreshes(double seconds, double hz);

// How intervals between refreshes spread; `histogram` counts them in tenths of a refresh, the last
// bin all from 3 refreshes up.
struct IntervalSummary {
    int count = 0;
    double mean = 0, deviation = 0, least = 0, most = 0; // seconds
    std::vector<int> histogram;
};
IntervalSummary summarise(const std::vector<double>& intervals, double hz);

} // namespace obscura
