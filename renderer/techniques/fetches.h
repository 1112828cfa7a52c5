#pragma once

#include "renderer/techniques/occlusion_passes.h"

#include <vector>

namespace obscura {

// Texture fetches that a technique makes for a pixel of the frame that it sees (a guard band's
// included), as the passes that its settings enable declare them (technique.h), each by its
// target's share of that frame: scale, layers, levels, `downscale`. It is the most, where no tap is
// beyond the border and nothing is left out; empty pixels make few. How many spheres are splatted
// on a pixel depends on the scene: one is counted.
double fetchesPerPixel(const Settings& settings);

// What the pixels of one level of a pass's target really make.
struct FetchCount {
    const Pass* pass;
    int level;
    double share;      // its pixels for each pixel of the frame
    double declared;   // the most of one pixel
    double most, mean; // of one pixel; all of its splats together
};

// Runs the technique, and each of its own passes once more with a counter in its shader. The frame
// must be bound.
std::vector<FetchCount> countFetches(const Settings& settings, const OcclusionInputs& inputs,
                                     int width, int height);

} // namespace obscura
