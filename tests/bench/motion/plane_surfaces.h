#pragma once

#include "renderer/frame/surfaces.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace obscura {

// What a camera sees of analytic scenes, without any rasteriser. All look from (x, y, z) along -z
// at planes that face them, with a focal length of `focal` pixels: at distance d, a metre is focal
// / d pixels wide.
constexpr int planeWidth = 48, planeHeight = 32;
constexpr double focal = 40;

inline Camera planeCamera(double x = 0, double z = 0, double turnDegrees = 0) {
    const double turn = turnDegrees * std::numbers::pi / 180;
    Camera camera;
    camera.position = {x, 0, z};
    camera.target = {x - std::sin(turn), 0, z - std::cos(turn)}; // turns left
    camera.fovDegrees = 2 * std::atan(planeHeight / 2 / focal) * 180 / std::numbers::pi;
    return camera;
}

// The planes face +z at the heights z that `heights` gives where the ray (origin, direction per
// unit of -z) meets them.
using PlaneOfRay = std::function<double(glm::dvec3 origin, glm::dvec3 ahead)>;

inline Surfaces planeSurfaces(const Camera& camera, const PlaneOfRay& heights) {
    const Bounds bounds{{-100, -100, -100}, {100, 100, 0}};
    Surfaces surfaces;
    surfaces.frame = makeFrame(camera, planeWidth, planeHeight, bounds, 1);
    surfaces.width = planeWidth;
    surfaces.height = planeHeight;
    const glm::dvec3 origin(camera.position[0], camera.position[1], camera.position[2]);
    const glm::vec3 normal = glm::mat3(surfaces.frame.viewFromWorld) * glm::vec3(0, 0, 1);
    for (int y = 0; y < planeHeight; ++y)
        for (int x = 0; x < planeWidth; ++x) {
            const glm::dvec3 ahead(
                glm::mat3(surfaces.frame.worldFromView) *
                surfaces.position(static_cast<float>(x), static_cast<float>(y), 1));
            const double depth = (heights(origin, ahead / -ahead.z) - origin.z) / ahead.z;
            surfaces.depth.push_back(static_cast<float>(depth));
            surfaces.normal.push_back(normal);
        }
    surfaces.faceNormal = surfaces.normal;
    return surfaces;
}

// One plane at z = -distance.
inline Surfaces wallSurfaces(const Camera& camera, double distance) {
    return planeSurfaces(camera, [=](glm::dvec3, glm::dvec3) { return -distance; });
}

} // namespace obscura
