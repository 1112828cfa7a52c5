#pragma once

#include "renderer/scene/scene.h"

#include <cstdint>
#include <vector>

namespace obscura {

// A point of a surface, and its triangle's normal: the side on which corners run against the clock.
struct SurfacePoint {
    glm::vec3 position{0}, normal{0};
    std::uint32_t firstIndex = 0; // where its triangle begins in Scene::indices
};

// Spread over triangles (given by where they begin in Scene::indices), the same each time: evenly
// by area, or each triangle alike, so that there are more where there is more detail. None where
// triangles have no area.
enum class Spread { byArea, byTriangle };
std::vector<SurfacePoint> surfacePoints(const Scene& scene,
                                        const std::vector<std::uint32_t>& triangles, int count,
                                        Spread spread);

// Where a scene is, for whoever points a camera at it. Its extremes mislead: a crumb that was left
// far away, or a floor of kilometres with a chair on it, makes everything else a dot.
struct Extent {
    // All but crumbs: less than some hundredths of the area, farther from the rest than the rest is
    // large, with nothing between.
    Bounds whole;
    // Without surroundings too: triangles each several times as large as everything else together,
    // such as a floor or the dome of a sky; and where nearly all triangles are in a small part of
    // the scene, all that is not there.
    Bounds subject;
    std::vector<std::uint32_t> wholeTriangles, subjectTriangles; // where they begin
    bool crumbs = false, surroundings = false;                   // were left out
};

// An Error where no triangle has an area.
Extent extentOf(const Scene& scene);

double diagonal(const Bounds& bounds);

} // namespace obscura
