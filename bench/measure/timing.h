#pragma once

#include "bench/sweep/row.h"
#include "gl/timer.h"
#include "matching/anchor.h"
#include "renderer/probe.h"

#include <functional>
#include <span>

namespace obscura {

// How long techniques take on one view. All are run in turn, each round in another random order, so
// that whatever drifts (clocks, heat, other programs) hits all alike; what is compared was measured
// within the same seconds.

struct TimingPlan {
    int frames = 200;   // of each configuration, or as many as fit in
    double seconds = 5; // of its own time, whichever is less; at least 3 frames
    double bytes = 1e9; // of GPU memory for techniques at once; more are timed in groups
    std::uint64_t seed = 1;
    gl::Timing timing = gl::Timing::finish;
};

struct PassTime {
    std::string name;
    int work = 0;      // index in workNames()
    double median = 0; // milliseconds
};

struct TechniqueTime {
    int frames = 0;
    Milliseconds total; // of the technique's passes
    std::vector<PassTime> passes;
    double gbuffer =
        0; // median of the G-buffer pass in the same rounds: depth, albedo, normals; ms
    double starcraft = 0;       // median of `starcraft` with 16 samples in the same rounds; ms
    double starcraftRepeat = 1; // its median in odd rounds over that in even ones
    double bytes = 0;           // of GPU memory that the technique adds
};

// Called after each frame with the share done, 0 ... 1.
using TimingProgress = std::function<void(double)>;

// Times all techniques on the probe's view. `radius` is that of the anchor, `starcraft`.
std::vector<TechniqueTime> timeTechniques(const Probe& probe, std::span<const Settings> techniques,
                                          double radius, const TimingPlan& plan,
                                          const TimingProgress& progress = {});

// The pixels that a guard band adds, as a share of the image's.
double guardShare(const Settings& settings, int width, int height);

// Bytes of GPU memory that a technique adds to an image of that size, its guard band included.
double addedBytes(const Settings& settings, int width, int height);

// Median and percentiles of numbers in any order; 0 without any number. Percentiles are
// interpolated between ranks (R's type 7).
Milliseconds summaryOf(std::vector<double> milliseconds);

} // namespace obscura
