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
    std::vector<double> truthfulness; // the share of the truth's occlusion; above 1: too dark
};

// Writes the technique that flickers most as an animated GIF: visibility, the truth, and unreal
// change (temporal_measures.h). Below it stands the steadiest technique on the same path, if that
// is another one. Only techniques that show half of the truth's occlusion or more are considered,
// because what shows nothing is steady; and only paths on which every frame differs. Returns the
// cell of the worst technique, with the GIF in the study's folder as its picture; nothing if no
// technique is left.
std::optional<StabilityCell> writeAnimation(const TemporalStudy& study, std::uint64_t noiseSeed,
                                            std::span<const MotionRecord> records);

} // namespace obscura
