#pragma once

#include "bench/motion/temporal_study.h"
#include "bench/motion/temporal_tests.h"

#include <optional>

namespace obscura {

// A test with a moving camera, as measured.
struct MotionRecord {
    const TemporalTest* test;
    std::vector<Image> truths;        // by frame
    std::vector<double> unreal;       // mean, of each configuration
    std::vector<double> truthfulness; // occlusion shown, of the truth's: above 1, too dark
};

// Writes the worst flicker as an animated GIF, and below it the best on the same path, if it is
// another's: visibility, the truth, and unreal change (temporal_measures.h). Only techniques that
// show half of the truth's occlusion or more are considered: what shows nothing is steady; and only
// paths on which every frame is another. Gives the worst one's cell, with the file in the study's
// folder as its picture; none without such a technique.
std::optional<StabilityCell> writeAnimation(const TemporalStudy& study, const Shots& shots,
                                            std::uint64_t noiseSeed,
                                            std::span<const MotionRecord> records);

} // namespace obscura
