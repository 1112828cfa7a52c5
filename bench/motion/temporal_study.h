#pragma once

#include "bench/motion/shots.h"
#include "bench/stability/cell.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// What the tests in motion (temporal.h) show, and how much of it.

// How much is drawn.
struct TemporalEffort {
    int width, height;
    int frames; // of each test, at least 3
    int rays;   // per pixel of the truth
    std::vector<std::string> tests;
};

struct TemporalStudy {
    const Scene& scene;
    Camera start;
    double radius; // metres; of the truth, and what the configurations have
    std::vector<NamedSettings> configurations;
    TemporalEffort effort;
    std::filesystem::path folder; // pictures/ in it takes the pictures
};

// The name of the 99th percentile of the headline among the cells' measures.
inline constexpr std::string_view unrealChange99 = "unreal change, 99th percentile";

// The name of the error of points that came into sight in the last frames (NewlySeen): ghosts show
// there.
inline constexpr std::string_view errorNewlySeen =
    "error where newly seen, in the last 8 frames, RMSE";

// The measure of the only cell of a run whose picture moves (temporal_animation.h).
inline constexpr std::string_view worstFlicker = "the worst flicker of the run";

} // namespace obscura
