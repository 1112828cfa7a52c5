#include "bench/stability/failure_scenes.h"

#include "renderer/scene/quads.h"

#include <cmath>
#include <numbers>

namespace obscura {

namespace {

constexpr float far = 60; // where things end that are meant to have no end

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

void addFloor(Scene& scene, glm::vec2 low, glm::vec2 high, float y = 0) {
    addQuad(scene, {glm::vec3(low.x, y, high.y), glm::vec3(high.x, y, high.y),
                    glm::vec3(high.x, y, low.y), glm::vec3(low.x, y, low.y)});
}

// x = const, facing +x.
void addWall(Scene& scene, float x, float low, float high) {
    addQuad(scene, {glm::vec3(x, low, far), glm::vec3(x, low, -far), glm::vec3(x, high, -far),
                    glm::vec3(x, high, far)});
}

Camera cameraAt(Vec3 position, Vec3 target, double fovDegrees) {
    Camera camera;
    camera.position = position;
    camera.target = target;
    camera.fovDegrees = fovDegrees;
    return camera;
}

double fieldOfView(double height, double distance) {
    return 2 * std::atan(height / (2 * distance)) * 180 / std::numbers::pi;
}

} // namespace

Scene floorScene() {
    Scene scene;
    addFloor(scene, glm::vec2(-150), glm::vec2(150));
    return scene;
}

Camera floorCamera(double degrees, double distance) {
    const double sine = std::sin(radians(degrees)), cosine = std::cos(radians(degrees));
    Camera camera = cameraAt({0, distance * cosine, distance * sine}, {0, 0, 0}, 60);
    camera.up = {0, sine, -cosine};
    return camera;
}

Scene boxScene() {
    Scene scene;
    addBox(scene, glm::vec3(-4), glm::vec3(0));
    return scene;
}

Camera boxCamera() { return cameraAt({4.9, 4.4, 5.4}, {0, 0, 0}, 44); }

Scene poleScene(double distance) {
    Scene scene;
    addQuad(scene, {glm::vec3(-40, -40, 0), glm::vec3(40, -40, 0), glm::vec3(40, 40, 0),
                    glm::vec3(-40, 40, 0)});
    const float half = poleWidth / 2, z = static_cast<float>(distance);
    addBox(scene, {-half, -30, z - half}, {half, 30, z + half});
    return scene;
}

Camera poleCamera(double distance) {
    return cameraAt({0, 0, distance + static_cast<double>(poleToCamera)}, {0, 0, distance}, 60);
}

Scene rodScene() {
    Scene scene;
    addFloor(scene, glm::vec2(-40), glm::vec2(40));
    for (const Rod& rod : rods)
        addBox(scene, {-30, rodHeight, rod.z - rod.width / 2},
               {30, rodHeight + rod.width, rod.z + rod.width / 2});
    return scene;
}

Camera rodCamera() { return cameraAt({0, 5.2, 7.4}, {0, 0, 0}, 40); }

Scene curbScene() {
    Scene scene;
    addFloor(scene, {-20, -far}, {0, far});
    addFloor(scene, {0, -far}, {20, far}, 2);
    addQuad(scene, {glm::vec3(0, 0, -far), glm::vec3(0, 0, far), glm::vec3(0, 2, far),
                    glm::vec3(0, 2, -far)});
    return scene;
}

Camera curbCamera() {
    Camera camera = cameraAt({0, 20, 0}, {0, 0, 0}, fieldOfView(3, 20));
    camera.up = {0, 0, -1};
    return camera;
}

Scene creaseScene() {
    Scene scene;
    addFloor(scene, {0, -far}, {far, far});
    addWall(scene, 0, 0, far);
    return scene;
}

double occlusionInCrease(double distance) {
    if (distance >= 1)
        return 0;
    return (std::acos(distance) - distance * std::sqrt(1 - distance * distance)) / std::numbers::pi;
}

Camera creaseCamera(double distance, double height, double degrees) {
    Camera camera =
        cameraAt({distance * std::cos(radians(degrees)), distance * std::sin(radians(degrees)), 0},
                 {0, 0, 0}, fieldOfView(height, distance));
    camera.near = std::min(0.1, distance / 100);
    return camera;
}

Camera creaseCameraAlong(double degrees) {
    return cameraAt({0.5, 6 * std::cos(radians(degrees)), 6 * std::sin(radians(degrees))},
                    {0.5, 0, 0}, 30);
}

Scene hallScene(double scale) {
    Scene scene;
    addFloor(scene, {-6, -12}, {6, 6});
    addQuad(scene,
            {glm::vec3(-6, 5, -12), glm::vec3(6, 5, -12), glm::vec3(6, 5, 6), glm::vec3(-6, 5, 6)});
    addQuad(scene, {glm::vec3(-6, 0, -12), glm::vec3(6, 0, -12), glm::vec3(6, 5, -12),
                    glm::vec3(-6, 5, -12)});
    addQuad(scene, {glm::vec3(-6, 0, 6), glm::vec3(-6, 0, -12), glm::vec3(-6, 5, -12),
                    glm::vec3(-6, 5, 6)});
    addQuad(scene,
            {glm::vec3(6, 0, -12), glm::vec3(6, 0, 6), glm::vec3(6, 5, 6), glm::vec3(6, 5, -12)});
    for (const float x : {-3.5f, 3.5f})
        for (const float z : {1.5f, -2.5f, -6.5f, -10.5f}) {
            addBox(scene, {x - 0.6f, 0, z - 0.6f}, {x + 0.6f, 0.3f, z + 0.6f});
            addBox(scene, {x - 0.4f, 0.3f, z - 0.4f}, {x + 0.4f, 4.6f, z + 0.4f});
            addBox(scene, {x - 0.6f, 4.6f, z - 0.6f}, {x + 0.6f, 5, z + 0.6f});
        }
    for (int step = 0; step < 4; ++step) {
        const float z = -11 + 0.35f * static_cast<float>(3 - step);
        addBox(scene, {-2, 0.3f * static_cast<float>(step), -12},
               {2, 0.3f * static_cast<float>(step + 1), z});
    }
    addBox(scene, {-1.6f, 0.5f, -4.1f}, {0.2f, 0.65f, -3.3f});
    for (const float x : {-1.5f, 0.0f})
        addBox(scene, {x, 0, -3.9f}, {x + 0.12f, 0.5f, -3.5f});
    addBox(scene, {0.9f, 0, -1.2f}, {1.7f, 0.8f, -0.4f});
    for (Vertex& vertex : scene.vertices)
        vertex.position *= static_cast<float>(scale);
    return scene;
}

Camera hallCamera(double scale) {
    Camera camera = cameraAt({1.1 * scale, 1.9 * scale, 4.2 * scale},
                             {-0.3 * scale, 1.3 * scale, -3.6 * scale}, 60);
    camera.near *= scale;
    return camera;
}

Camera rolled(Camera camera, double degrees) {
    const auto vector = [](const Vec3& v) { return glm::dvec3(v[0], v[1], v[2]); };
    const glm::dvec3 forward = glm::normalize(vector(camera.target) - vector(camera.position));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, vector(camera.up)));
    const glm::dvec3 up = std::cos(radians(degrees)) * glm::cross(right, forward) +
                          std::sin(radians(degrees)) * right;
    camera.up = {up.x, up.y, up.z};
    return camera;
}

} // namespace obscura
