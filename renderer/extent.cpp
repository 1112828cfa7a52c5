#include "renderer/extent.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace obscura {

namespace {

using Triangles = std::vector<std::uint32_t>;

constexpr int pointsOfSurfaces = 4096;
constexpr double areaTail = 0.005;   // of the area, beyond each face of the box around most of it
constexpr double detailTail = 0.025; // and of the triangles
constexpr double small = 1.0 / 3;    // part of the scene's size
constexpr double backdrop = 3;       // times as large as all else
constexpr std::size_t few = 12;      // triangles that are too few to be all that matters

glm::vec3 corner(const Scene& scene, std::uint32_t index) {
    return scene.vertices[scene.indices[index]].position;
}

Bounds boundsOf(const Scene& scene, std::uint32_t first) {
    const glm::vec3 a = corner(scene, first), b = corner(scene, first + 1),
                    c = corner(scene, first + 2);
    return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
}

Bounds joined(const Bounds& a, const Bounds& b) {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

Bounds boundsOf(const Scene& scene, const Triangles& triangles) {
    Bounds bounds = boundsOf(scene, triangles.front());
    for (const std::uint32_t first : triangles)
        bounds = joined(bounds, boundsOf(scene, first));
    return bounds;
}

double areaOf(const Scene& scene, std::uint32_t first) {
    const glm::dvec3 a(corner(scene, first));
    const double area = 0.5 * glm::length(glm::cross(glm::dvec3(corner(scene, first + 1)) - a,
                                                     glm::dvec3(corner(scene, first + 2)) - a));
    return std::isfinite(area) ? area : 0;
}

Triangles withArea(const Scene& scene) {
    Triangles result;
    for (const Mesh& mesh : scene.meshes)
        for (std::uint32_t i = 0; i < mesh.indexCount; i += 3)
            if (areaOf(scene, mesh.firstIndex + i) > 0)
                result.push_back(mesh.firstIndex + i);
    return result;
}

// The box that all but the tails of area or triangles lie in.
Bounds coreOf(const Scene& scene, const Triangles& triangles, Spread spread, double tail) {
    const std::vector<SurfacePoint> all = surfacePoints(scene, triangles, pointsOfSurfaces, spread);
    const auto out = static_cast<std::ptrdiff_t>(tail * static_cast<double>(all.size()));
    Bounds core;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<float> values;
        for (const SurfacePoint& point : all)
            values.push_back(point.position[axis]);
        std::sort(values.begin(), values.end());
        core.low[axis] = *(values.begin() + out);
        core.high[axis] = *(values.end() - 1 - out);
    }
    return core;
}

// Walks outwards from the box around most of the area; what lies beyond a gap as wide as that box
// is crumbs.
Triangles withoutCrumbs(const Scene& scene, const Triangles& triangles) {
    const Bounds core = coreOf(scene, triangles, Spread::byArea, areaTail);
    struct Outside {
        float nearest, farthest; // from the core, along some axis
        std::uint32_t first;
    };
    const auto largest = [](const glm::vec3& v) { return std::max({v.x, v.y, v.z, 0.0f}); };
    std::vector<Outside> outside;
    Triangles kept;
    for (const std::uint32_t first : triangles) {
        const Bounds at = boundsOf(scene, first);
        const float nearest = largest(glm::max(core.low - at.high, at.low - core.high));
        if (nearest > 0)
            outside.push_back(
                {nearest, largest(glm::max(core.low - at.low, at.high - core.high)), first});
        else
            kept.push_back(first);
    }
    std::sort(outside.begin(), outside.end(),
              [](const Outside& a, const Outside& b) { return a.nearest < b.nearest; });
    const auto gap = static_cast<float>(diagonal(core));
    float reach = 0;
    for (const Outside& each : outside) {
        if (each.nearest > reach + gap)
            break;
        reach = std::max(reach, each.farthest);
        kept.push_back(each.first);
    }
    return kept;
}

// From small triangles to large ones; ends where the next is several times as large as all so far
// together.
Triangles withoutBackdrop(const Scene& scene, const Triangles& triangles) {
    std::vector<std::pair<float, std::uint32_t>> bySize;
    for (const std::uint32_t first : triangles) {
        const Bounds at = boundsOf(scene, first);
        bySize.emplace_back(glm::distance(at.low, at.high), first);
    }
    std::sort(bySize.begin(), bySize.end());
    Bounds bounds = boundsOf(scene, bySize.front().second);
    Triangles kept;
    for (const auto& [size, first] : bySize) {
        if (kept.size() >= std::max(few, triangles.size() / 100) &&
            static_cast<double>(size) > backdrop * diagonal(bounds))
            return kept;
        bounds = joined(bounds, boundsOf(scene, first));
        kept.push_back(first);
    }
    return triangles;
}

// What is in or touches the small part of the scene where nearly all triangles are, if there is
// one, and is not much larger than that.
Triangles withoutPlainParts(const Scene& scene, const Triangles& triangles) {
    const Bounds core = coreOf(scene, triangles, Spread::byTriangle, detailTail);
    const double size = diagonal(core);
    if (!(size < small * diagonal(boundsOf(scene, triangles))))
        return triangles;
    const auto around = static_cast<float>(0.1 * size);
    Triangles kept;
    for (const std::uint32_t first : triangles) {
        const Bounds at = boundsOf(scene, first);
        const bool near = glm::all(glm::lessThan(at.low, core.high + around)) &&
                          glm::all(glm::greaterThan(at.high, core.low - around));
        if (near && diagonal(at) < size)
            kept.push_back(first);
    }
    return kept.empty() ? triangles : kept;
}

} // namespace

double diagonal(const Bounds& bounds) {
    return glm::distance(glm::dvec3(bounds.low), glm::dvec3(bounds.high));
}

std::vector<SurfacePoint> surfacePoints(const Scene& scene, const Triangles& triangles, int count,
                                        Spread spread) {
    const auto weight = [&](std::uint32_t first) {
        return spread == Spread::byArea ? areaOf(scene, first) : 1;
    };
    double all = 0;
    for (const std::uint32_t first : triangles)
        all += weight(first);
    std::vector<SurfacePoint> result;
    double before = 0;
    for (const std::uint32_t first : triangles) {
        before += weight(first);
        while (static_cast<double>(result.size()) + 0.5 < before / all * count) {
            // Roberts 2018, "The unreasonable effectiveness of quasirandom sequences": R2.
            const auto i = static_cast<double>(result.size());
            auto u = static_cast<float>(std::fmod(0.5 + i * 0.7548776662466927, 1)),
                 v = static_cast<float>(std::fmod(0.5 + i * 0.5698402909980532, 1));
            if (u + v > 1) {
                u = 1 - u;
                v = 1 - v;
            }
            const glm::vec3 a = corner(scene, first), b = corner(scene, first + 1) - a,
                            c = corner(scene, first + 2) - a;
            result.push_back({a + u * b + v * c, glm::normalize(glm::cross(b, c)), first});
        }
    }
    return result;
}

Extent extentOf(const Scene& scene) {
    const Triangles all = withArea(scene);
    if (all.empty())
        throw Error("expected a scene with a surface to look at, found none: no triangle has an "
                    "area; export it with its meshes");
    Extent extent;
    extent.wholeTriangles = withoutCrumbs(scene, all);
    extent.subjectTriangles =
        withoutPlainParts(scene, withoutBackdrop(scene, extent.wholeTriangles));
    extent.surroundings = extent.subjectTriangles.size() < extent.wholeTriangles.size();
    extent.crumbs = extent.wholeTriangles.size() < all.size();
    if (extent.surroundings) { // before them, crumbs may have been nothing out of the way
        const Triangles kept = withoutCrumbs(scene, extent.subjectTriangles);
        extent.crumbs |= kept.size() < extent.subjectTriangles.size();
        extent.subjectTriangles = kept;
    }
    extent.whole = boundsOf(scene, extent.wholeTriangles);
    extent.subject = boundsOf(scene, extent.subjectTriangles);
    return extent;
}

} // namespace obscura
