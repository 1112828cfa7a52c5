#include "bench/motion/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

constexpr int frames = 60;

// 5 m from its target, both at one height.
Camera start() {
    Camera camera;
    camera.position = {1, 2, 3};
    camera.target = {4, 2, -1};
    return camera;
}

struct Offset {
    double x, y, z;
    double length() const { return std::hypot(x, y, z); }
};
Offset ahead(const Camera& camera) {
    return {camera.target[0] - camera.position[0], camera.target[1] - camera.position[1],
            camera.target[2] - camera.position[2]};
}

double degreesBetween(const Offset& a, const Offset& b) {
    const double cosine = (a.x * b.x + a.y * b.y + a.z * b.z) / (a.length() * b.length());
    return std::acos(std::min(cosine, 1.0)) * 180 / std::numbers::pi;
}

TEST(CameraPath, ADollyGoesStraightToTheTarget) {
    const Camera camera = dollied(start(), 40, frames);
    EXPECT_EQ(camera.target, start().target);
    EXPECT_NEAR(ahead(camera).length(), 4.5, 1e-12); // 40 / 400 of 5 m nearer
    EXPECT_NEAR(degreesBetween(ahead(camera), ahead(start())), 0, 1e-5);
}

TEST(CameraPath, AnOrbitKeepsItsDistanceAndHeight) {
    const Camera camera = orbited(start(), 40, frames);
    EXPECT_EQ(camera.target, start().target);
    EXPECT_NEAR(ahead(camera).length(), 5, 1e-12);
    EXPECT_NEAR(camera.position[1], 2, 1e-12);
    EXPECT_NEAR(degreesBetween(ahead(camera), ahead(start())), 8, 1e-9);
}

TEST(CameraPath, ATurnStaysOnTheSpot) {
    const Camera camera = turned(start(), 40, frames);
    EXPECT_EQ(camera.position, start().position);
    EXPECT_NEAR(ahead(camera).length(), 5, 1e-12);
    EXPECT_NEAR(camera.target[1], 2, 1e-12);
    EXPECT_NEAR(degreesBetween(ahead(camera), ahead(start())), 4, 1e-9);
}

TEST(CameraPath, ACutHappensOnceHalfWay) {
    EXPECT_EQ(cut(start(), 29, frames).position, start().position);
    EXPECT_NEAR(ahead(cut(start(), 30, frames)).length(), 2.5, 1e-12);
    EXPECT_EQ(cut(start(), 59, frames).position, cut(start(), 30, frames).position);
}

} // namespace
} // namespace obscura
