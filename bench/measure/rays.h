#pragma once

#include "renderer/reference/reference.h"

namespace obscura {

// Rays per second of one core, by the time that the processor spent on them; other programs on the
// machine do not count.
struct RayRates {
    double rays = 0;    // that were traced; rays below the face are not
    double ours = 0;    // RayTracer::trace, with all it does
    double single = 0;  // a bare Embree loop over the very same rays, one by one
    double packets = 0; // the same in packets of sixteen
    double wall = 0;    // seconds that RayTracer::trace took
};
RayRates measureRays(const Scene& scene, const Surfaces& surfaces, const TraceSettings& settings);

} // namespace obscura
