// Motion that is known in closed form.
#include "bench/motion/reprojection.h"
#include "tests/bench/motion/plane_surfaces.h"

#include <gtest/gtest.h>

namespace obscura {
namespace {

constexpr double centreX = (planeWidth - 1) / 2.0, centreY = (planeHeight - 1) / 2.0;

using Place = std::function<glm::dvec2(double x, double y)>;

// Of every pixel, with those outside the image invalid.
void expectPlaces(const Reprojection& reprojection, const Place& expected) {
    int valid = 0;
    for (int y = 0; y < planeHeight; ++y)
        for (int x = 0; x < planeWidth; ++x) {
            const auto pixel = static_cast<std::size_t>(y * planeWidth + x);
            const glm::dvec2 place = expected(x, y);
            const double margin =
                std::min({place.x, place.y, planeWidth - 1 - place.x, planeHeight - 1 - place.y});
            if (std::abs(margin) < 2e-3) // rounding decides
                continue;
            ASSERT_EQ(reprojection.valid(pixel), margin > 0) << x << ", " << y;
            if (margin < 0)
                continue;
            ++valid;
            EXPECT_NEAR(reprojection.place(pixel).x, place.x, 2e-3);
            EXPECT_NEAR(reprojection.place(pixel).y, place.y, 2e-3);
        }
    EXPECT_GT(valid, planeWidth * planeHeight / 2);
}

TEST(Reprojection, AStepAsideMovesAWallByFocalOverDistance) {
    const Reprojection back(wallSurfaces(planeCamera(0.25), 4), wallSurfaces(planeCamera(), 4));
    // What the camera stepped towards was further right before: 40 / 4 x 0.25 pixels.
    expectPlaces(back, [](double x, double y) { return glm::dvec2(x + 2.5, y); });
}

TEST(Reprojection, AStepForwardScalesAWall) {
    const Reprojection back(wallSurfaces(planeCamera(0, -1), 4), wallSurfaces(planeCamera(), 4));
    expectPlaces(back, [](double x, double y) {
        return glm::dvec2(centreX + (x - centreX) * 3 / 4, centreY + (y - centreY) * 3 / 4);
    });
}

TEST(Reprojection, ATurnMovesDirections) {
    const double turn = 3 * std::numbers::pi / 180;
    const Reprojection back(wallSurfaces(planeCamera(0, 0, 3), 4), wallSurfaces(planeCamera(), 4));
    // After a turn to the left a pixel shows what was further left before; rows converge.
    expectPlaces(back, [&](double x, double y) {
        const double angle = std::atan((x - centreX) / focal);
        return glm::dvec2(centreX + focal * std::tan(angle - turn),
                          centreY + (y - centreY) * std::cos(angle) / std::cos(angle - turn));
    });
}

TEST(Reprojection, AStillCameraKeepsEveryPixelExactly) {
    const Surfaces wall = wallSurfaces(planeCamera(0.3, 0.1, 7), 4);
    const Reprojection same(wall, wall);
    Image image{planeWidth, planeHeight, 1, {}};
    for (int i = 0; i < planeWidth * planeHeight; ++i)
        image.pixels.push_back(static_cast<float>(i * 7919 % 1000));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        ASSERT_TRUE(same.valid(i));
        EXPECT_EQ(same.fetch(image, i), image.pixels[i]);
    }
}

// A near wall at distance 2 hides the left of a far one at distance 4. From x = 0.5 the far wall
// shows right of x = -0.5, from x = 0 right of x = 0.
TEST(Reprojection, WhatWasHiddenIsInvalid) {
    const PlaneOfRay walls = [](glm::dvec3 origin, glm::dvec3 ahead) {
        return origin.x + 2 * ahead.x < 0 ? -2.0 : -4.0;
    };
    const Surfaces now = planeSurfaces(planeCamera(0.5), walls);
    const Reprojection back(now, planeSurfaces(planeCamera(), walls));
    int hidden = 0;
    for (int x = 0; x < planeWidth; ++x) {
        const double perDepth = (x - centreX) / focal;
        const bool near = 0.5 + 2 * perDepth < 0;
        const double distance = near ? 2 : 4, world = 0.5 + distance * perDepth;
        const double before =
            centreX + world / distance * focal;         // where it was, or would have been
        const double edge = std::abs(centreX - before); // from the near wall's edge, then
        if (edge < 1 || std::abs(before - (planeWidth - 1)) < 1)
            continue; // a fetch that may read both walls, or the border
        const bool visible = before < planeWidth - 1 && (near || world > 0);
        EXPECT_EQ(back.valid(static_cast<std::size_t>(planeWidth * planeHeight / 2 + x)), visible)
            << x;
        hidden += !visible && world < 0;
    }
    EXPECT_EQ(hidden, 4); // 5 pixels of far wall, 0.1 m each, less the one beside the edge
}

// The far wall beside the near one's edge: a bilinear fetch there reads both walls, but one of its
// pixels shows the point's own surface. Only what no pixel showed was not seen.
TEST(Reprojection, WhatIsSeenBesideAnEdgeIsNotHidden) {
    const PlaneOfRay walls = [](glm::dvec3 origin, glm::dvec3 ahead) {
        return origin.x + 2 * ahead.x < 0 ? -2.0 : -4.0;
    };
    const Surfaces now = planeSurfaces(planeCamera(0.53), walls),
                   before = planeSurfaces(planeCamera(), walls);
    const Reprojection back(now, before);
    int unseen = 0, beside = 0;
    for (std::size_t x = 0; x < planeWidth; ++x) {
        const std::size_t pixel = planeWidth * planeHeight / 2 + x;
        const auto seen = back.seenAt(pixel);
        ASSERT_TRUE(seen || !back.valid(pixel));
        if (!seen)
            ++unseen;
        else
            EXPECT_EQ(now.depth[pixel], before.depth[*seen]) << x;
        beside += seen && !back.valid(pixel);
    }
    EXPECT_EQ(beside, 2); // one pixel of each wall
    // 5.3 pixels of far wall came from behind the near one, and as many over the right border.
    EXPECT_NEAR(unseen, 2 * 5.3, 2);
}

TEST(Reprojection, BilinearFetchesBlurAsTheHeaderSays) {
    const Reprojection back(wallSurfaces(planeCamera(0.05), 4), wallSurfaces(planeCamera(), 4));
    for (const int period : {2, 10}) { // moved by half a pixel
        Image waves{planeWidth, planeHeight, 1, {}};
        for (int i = 0; i < planeWidth * planeHeight; ++i)
            waves.pixels.push_back(static_cast<float>(
                std::cos(2 * std::numbers::pi * (i % planeWidth - 0.5) / period)));
        const double crest = static_cast<double>(back.fetch(waves, 0)); // at 0.5: the top
        EXPECT_NEAR(crest, std::cos(std::numbers::pi / period), 1e-3);
    }
}

} // namespace
} // namespace obscura
