#pragma once

#include "bench/motion/temporal.h"

namespace obscura {

// Camera paths through a scene, for steadiness from frame to frame.
struct Motion {
    Scene scene;
    Camera start;
    double radius = 0.5; // metres; of truth and techniques
    TemporalEffort effort;
};

} // namespace obscura
