#include "bench/motion/camera_path.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/glm.hpp>

namespace obscura {

namespace {

glm::dvec3 vec(const Vec3& v) { return {v[0], v[1], v[2]}; }
Vec3 array(glm::dvec3 v) { return {v.x, v.y, v.z}; }

glm::dvec3 aboutUp(const Camera& camera, glm::dvec3 v, double degrees) {
    const glm::dmat3 turn(
        glm::rotate(glm::dmat4(1), glm::radians(degrees), glm::normalize(vec(camera.up))));
    return turn * v;
}

Camera closer(Camera camera, double share) {
    camera.position = array(glm::mix(vec(camera.position), vec(camera.target), share));
    return camera;
}

} // namespace

Camera dollied(const Camera& start, int frame, int) { return closer(start, frame / 400.0); }

Camera orbited(const Camera& start, int frame, int) {
    Camera camera = start;
    const glm::dvec3 target = vec(start.target);
    camera.position = array(target + aboutUp(start, vec(start.position) - target, -0.2 * frame));
    return camera;
}

Camera turned(const Camera& start, int frame, int) {
    Camera camera = start;
    const glm::dvec3 position = vec(start.position);
    camera.target = array(position + aboutUp(start, vec(start.target) - position, 0.1 * frame));
    return camera;
}

Camera cut(const Camera& start, int frame, int frames) {
    return frame < frames / 2 ? start : closer(start, 0.5);
}

} // namespace obscura
