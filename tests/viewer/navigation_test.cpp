#include "viewer/navigation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

constexpr double quarter = std::numbers::pi / 2;

void expectNear(const Vec3& found, const Vec3& expected) {
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(found[i], expected[i], 1e-9) << "coordinate " << i;
}

// At eye height, looking along -z at a point 4 m away.
Camera ahead() { return {{0, 1.6, 0}, {0, 1.6, -4}, {0, 1, 0}, 90, 0}; }

TEST(Navigation, LookingRightByAQuarterLooksAlongX) {
    const Camera camera = looked(ahead(), quarter, 0);
    expectNear(camera.position, {0, 1.6, 0});
    expectNear(camera.target, {4, 1.6, 0});
}

TEST(Navigation, LookingUpStopsBeforeTheZenithAndComesBack) {
    const Camera up = looked(ahead(), 0, 10);
    EXPECT_EQ(faultOf(up), "");
    EXPECT_GT(up.target[1], 1.6 + 3.99);
    const Camera down = looked(up, 0, -20);
    EXPECT_EQ(faultOf(down), "");
    EXPECT_LT(down.target[1], 1.6 - 3.99);
    EXPECT_NEAR(focusDistance(down), 4, 1e-9);
}

TEST(Navigation, FlyingMovesCameraAndTargetAlongTheCamerasOwnAxes) {
    const Camera camera = flown(looked(ahead(), quarter, 0), 1, 2, 3);
    expectNear(camera.position, {3, 3.6, 1});
    expectNear(camera.target, {7, 3.6, 1});
}

TEST(Navigation, OrbitingKeepsTargetAndDistance) {
    const Camera quarterRound = orbited(ahead(), quarter, 0);
    expectNear(quarterRound.target, {0, 1.6, -4});
    expectNear(quarterRound.position, {-4, 1.6, -4}); // which then looks along +x
    const Camera above = orbited(ahead(), 0, quarter / 3);
    EXPECT_GT(above.position[1], 1.6); // dragging downwards, what is above comes into view
    EXPECT_NEAR(focusDistance(above), 4, 1e-9);
}

// With 90 degrees, the picture is 8 m high at the target.
TEST(Navigation, PanningCarriesTheTargetAcrossThePicture) {
    const Camera camera = panned(ahead(), 0.25, 0.5);
    expectNear(camera.position, {-2, 1.6 - 4, 0});
    expectNear(camera.target, {-2, 1.6 - 4, -4});
}

TEST(Navigation, DollyingChangesTheDistanceAlone) {
    const Camera camera = dollied(ahead(), 0.5);
    expectNear(camera.position, {0, 1.6, -2});
    expectNear(camera.target, {0, 1.6, -4});
}

TEST(Navigation, ZoomingEnlargesByTheFieldOfViewAlone) {
    const Camera camera = zoomed(ahead(), 2);
    EXPECT_NEAR(std::tan(camera.fovDegrees * std::numbers::pi / 360), 0.5, 1e-9);
    expectNear(camera.position, ahead().position);
    EXPECT_EQ(zoomed(ahead(), 1e6).fovDegrees, 1);
    EXPECT_EQ(zoomed(ahead(), 1e-6).fovDegrees, 120);
}

TEST(Navigation, AWheelTurnedBackGivesTheSpeedBack) {
    EXPECT_GT(nextSpeed(2, 1), 2);
    EXPECT_NEAR(nextSpeed(nextSpeed(2, 5), -5), 2, 1e-12);
}

} // namespace
} // namespace obscura
