#pragma once

#include "bench/stability/cell.h"
#include "protocols/reader/protocol.h"

#include <span>

namespace obscura {

struct TemporalTest {
    StabilityTest test;
    Camera (*camera)(const Camera& start, int frame, int frames); // camera_path.h
    bool cyclesNoise;                                             // else it keeps to its pixels
};

std::span<const TemporalTest> temporalTests();

// An unknown id is an Error that lists them.
const TemporalTest& temporalTest(const std::string& id);

} // namespace obscura
