#pragma once

#include "gl/timer.h"
#include "renderer/probe.h"

#include <span>
#include <vector>

namespace obscura {

// How long the passes of techniques take on one view, for one frame without anti-aliasing. All run
// in turn with an anchor, each round in another random order, so that whatever drifts hits all
// alike: a glance of seconds, where obscura-bench sweep measures for minutes. The fastest frame
// counts, for other work on the machine only adds.
struct TechniqueTimes {
    std::vector<double> milliseconds; // in the order asked for; 0 for `none`
    double starcraft = 0;             // the anchor: `starcraft` with 16 samples
};

// `radius` (metres) is that of the anchor.
TechniqueTimes timesOf(const Probe& probe, std::span<const Settings> techniques, double radius,
                       gl::Timing timing, std::uint64_t seed);

} // namespace obscura
