#pragma once

#include "renderer/reference/reference.h"

#include <array>
#include <cmath>
#include <numbers>

namespace obscura {

// Scenes with closed forms of visibility (fact sheet, section A.1) as meshes, with the surface
// point that each is about: the origin, on a floor whose normal is +z.

constexpr double pi = std::numbers::pi;

// A scene put together in any coordinates, and then turned: Sobol points know axes, and a wall that
// lies along one is met too well.
class Build {
  public:
    Build() {
        scene_.materials.push_back({});
        scene_.meshes.push_back({});
    }
    Build& quad(std::array<glm::dvec3, 4> corners) {
        const auto first = static_cast<std::uint32_t>(scene_.vertices.size());
        for (const glm::dvec3& corner : corners)
            scene_.vertices.push_back({glm::vec3(turn() * corner), {}, {}, {}});
        for (const std::uint32_t i : {0, 1, 2, 0, 2, 3})
            scene_.indices.push_back(first + i);
        scene_.meshes[0].indexCount = static_cast<std::uint32_t>(scene_.indices.size());
        return *this;
    }
    // From (x0, z0) to (x1, z1), along y from -reach to reach.
    Build& strip(double x0, double z0, double x1, double z1, double reach) {
        return quad({glm::dvec3(x0, -reach, z0), glm::dvec3(x1, -reach, z1),
                     glm::dvec3(x1, reach, z1), glm::dvec3(x0, reach, z0)});
    }
    Build& floor(double reach) { return strip(-reach, 0, reach, 0, reach); }
    // Corners lie outside the sphere by as much as the middles of edges lie inside.
    Build& sphere(glm::dvec3 centre, double radius) {
        constexpr int around = 256, down = 128;
        const double outer = radius * (1 + std::pow(pi / around, 2) / 4);
        const auto at = [&](int i, int j) {
            const double azimuth = 2 * pi * i / around, polar = pi * j / down;
            return centre + outer * glm::dvec3(std::sin(polar) * std::cos(azimuth),
                                               std::sin(polar) * std::sin(azimuth),
                                               std::cos(polar));
        };
        for (int i = 0; i < around; ++i)
            for (int j = 0; j < down; ++j)
                quad({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        return *this;
    }
    // An upright pipe of the circle's area around (x, 0).
    Build& pipe(double x, double radius, double height) {
        constexpr int around = 1024;
        const double outer = radius * std::sqrt(2 * pi / around / std::sin(2 * pi / around));
        for (int i = 0; i < around; ++i) {
            const auto at = [&](int k, double z) {
                const double azimuth = 2 * pi * k / around;
                return glm::dvec3(x + outer * std::cos(azimuth), outer * std::sin(azimuth), z);
            };
            quad({at(i, 0), at(i + 1, 0), at(i + 1, height), at(i, height)});
        }
        return *this;
    }

    // Any rotation will do.
    static glm::dmat3 turn() {
        const double a = 0.7, b = 1.1;
        return glm::dmat3(std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a), 0, 0, 0, 1) *
               glm::dmat3(1, 0, 0, 0, std::cos(b), std::sin(b), 0, -std::sin(b), std::cos(b)) *
               glm::dmat3(std::cos(b), std::sin(b), 0, -std::sin(b), std::cos(b), 0, 0, 0, 1);
    }
    operator const Scene&() const { return scene_; }
    Scene& scene() { return scene_; }

  private:
    Scene scene_;
};

// `count` pixels that all show the origin, face normal +z, the normal tilted from it.
inline Surfaces originSurfaces(const Scene& scene, int count, double tilt = 0) {
    Surfaces surfaces;
    surfaces.width = count;
    surfaces.height = 1;
    surfaces.frame.viewFromWorld = surfaces.frame.worldFromView = glm::mat4(1);
    surfaces.frame.viewFromWorld[3] = {0, 0, -1, 1};
    surfaces.frame.worldFromView[3] = {0, 0, 1, 1}; // the origin is at depth 1
    surfaces.frame.viewFromUv = glm::vec4(0);
    surfaces.frame.size = {count, 1, 1.0 / count, 1};
    const Bounds bounds = scene.bounds();
    surfaces.frame.depth = {0.1, glm::distance(bounds.low, bounds.high) / 2 + 2, 1, 1};
    const auto size = static_cast<std::size_t>(count);
    surfaces.depth.assign(size, 1.0f);
    surfaces.faceNormal.assign(size, glm::vec3(Build::turn() * glm::dvec3(0, 0, 1)));
    surfaces.normal.assign(
        size, glm::vec3(Build::turn() * glm::dvec3(std::sin(tilt), 0, std::cos(tilt))));
    return surfaces;
}

} // namespace obscura
