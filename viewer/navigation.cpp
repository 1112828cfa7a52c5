#include "viewer/navigation.h"

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

using glm::dvec3;

dvec3 from(const Vec3& v) { return {v[0], v[1], v[2]}; }
Vec3 to(const dvec3& v) { return {v.x, v.y, v.z}; }

// The camera's own axes. `right` and `level` are at right angles to `up`; `level` is the direction
// of view laid flat.
struct Axes {
    dvec3 forward, right, up, level;
};

Axes axesOf(const Camera& camera) {
    Axes axes;
    axes.up = glm::normalize(from(camera.up));
    axes.forward = glm::normalize(from(camera.target) - from(camera.position));
    axes.right = glm::normalize(glm::cross(axes.forward, axes.up));
    axes.level = glm::cross(axes.up, axes.right);
    return axes;
}

// The direction after turning to the right and up, never nearer than half a degree to `up`.
dvec3 turned(const Axes& axes, double right, double up) {
    constexpr double steepest = glm::half_pi<double>() - 0.0087;
    const double elevation = std::asin(std::clamp(glm::dot(axes.forward, axes.up), -1.0, 1.0)) + up;
    const double steep = std::clamp(elevation, -steepest, steepest);
    const dvec3 level = std::cos(right) * axes.level + std::sin(right) * axes.right;
    return std::cos(steep) * level + std::sin(steep) * axes.up;
}

Camera moved(Camera camera, const dvec3& by) {
    camera.position = to(from(camera.position) + by);
    camera.target = to(from(camera.target) + by);
    return camera;
}

} // namespace

double focusDistance(const Camera& camera) {
    return glm::length(from(camera.target) - from(camera.position));
}

Camera looked(const Camera& camera, double right, double up) {
    Camera result = camera;
    result.target =
        to(from(camera.position) + focusDistance(camera) * turned(axesOf(camera), right, up));
    return result;
}

Camera flown(const Camera& camera, double right, double up, double forward) {
    const Axes axes = axesOf(camera);
    return moved(camera, right * axes.right + up * axes.up + forward * axes.forward);
}

Camera orbited(const Camera& camera, double right, double up) {
    Camera result = camera;
    result.position =
        to(from(camera.target) - focusDistance(camera) * turned(axesOf(camera), right, -up));
    return result;
}

Camera panned(const Camera& camera, double right, double up) {
    const Axes axes = axesOf(camera);
    const double height = 2 * focusDistance(camera) * std::tan(glm::radians(camera.fovDegrees) / 2);
    return moved(camera,
                 -height * (right * axes.right + up * glm::cross(axes.right, axes.forward)));
}

Camera dollied(const Camera& camera, double factor) {
    Camera result = camera;
    result.position =
        to(from(camera.target) - factor * (from(camera.target) - from(camera.position)));
    return result;
}

Camera zoomed(const Camera& camera, double factor) {
    Camera result = camera;
    const double tangent = std::tan(glm::radians(camera.fovDegrees) / 2) / factor;
    result.fovDegrees = std::clamp(glm::degrees(2 * std::atan(tangent)), 1.0, 120.0);
    return result;
}

// To two digits, for it is read.
double walkingSpeed(double diagonal) {
    const double speed = diagonal / 12;
    const double unit = std::pow(10, std::floor(std::log10(speed)) - 1);
    return std::round(speed / unit) * unit;
}

double nextSpeed(double speed, double notches) { return speed * std::pow(1.25, notches); }

} // namespace obscura
