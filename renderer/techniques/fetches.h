#pragma once

#include "renderer/techniques/occlusion_passes.h"

#include <vector>

namespace obscura {

// Texture fetches that a technique makes for each pixel of the frame that it sees, guard band
// included. They are what the enabled passes declare (technique.h), each pass weighted by the
// pixels that its target has for each pixel of that frame (scale, layers, levels, `downscale`).
// This is the most, reached where no tap lies beyond the border and nothing is skipped; empty
// pixels need few. How many spheres or triangles' boxes lie over a pixel depends on the scene, so
// one is counted.
double fetchesPerPixel(const Settings& settings);

// The fetches that pixels in one level of a pass's target really make.
struct FetchCount {
    const Pass* pass;
    int level;
    double share;      // pixels of this level for each pixel of the frame
    double declared;   // the most that one pixel may make
    double most, mean; // that were counted for one pixel, all of its splats together
};

// Runs the technique, and each of its own passes once more with a counter in its shader. The frame
// must be bound.
std::vector<FetchCount> countFetches(const Settings& settings, const OcclusionInputs& inputs,
                                     int width, int height);

} // namespace obscura
