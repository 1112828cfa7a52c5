#pragma once

#include "renderer/scene/scene.h"

#include <vector>

namespace obscura {

// A triangle as object-space techniques read it, laid out as shaders have it.
struct Occluder {
    glm::vec4 a, b, c; // xyz: corners, world space (metres), against the clock seen from the front.
                       // a.w: coverage, the share of the triangle that has no holes, 0 ... 1;
                       // b.w: 1 where the material is double-sided, else 0
};

// All triangles that have an area, in the scene's order. Coverage of masked materials is the mean
// over 64 places of each triangle (its base colour map read at the nearest texel of level 0).
std::vector<Occluder> occluders(const Scene& scene);

} // namespace obscura
