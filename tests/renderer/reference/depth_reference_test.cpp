// The depth-buffer reference on depth buffers that are written down, against closed forms.
#include "renderer/reference/depth_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

constexpr double pi = std::numbers::pi;

// A camera at the origin, `distance` metres above what it looks straight down on, whose height
// above that is `height(x, y)`; a pixel is `pixel` metres wide there.
template <typename Height>
Surfaces fromAbove(int width, int height, float distance, float pixel, Height&& heightAt) {
    Surfaces surfaces;
    surfaces.width = width;
    surfaces.height = height;
    const float across = pixel * static_cast<float>(width) / distance,
                up = pixel * static_cast<float>(height) / distance;
    surfaces.frame.viewFromUv = {across, up, -across / 2, -up / 2};
    surfaces.frame.size = {width, height, 1.0f / static_cast<float>(width),
                           1.0f / static_cast<float>(height)};
    surfaces.frame.depth = {0.01f, 1e6f, distance, 1};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 at =
                surfaces.position(static_cast<float>(x), static_cast<float>(y), distance);
            surfaces.depth.push_back(distance - heightAt(at.x, at.y));
            surfaces.normal.emplace_back(0, 0, 1);
        }
    surfaces.faceNormal = surfaces.normal;
    return surfaces;
}

constexpr int size = 641;

// A step of that height at `distance` from the middle column, half-way between two pixels.
Surfaces curb(float distance, float step) {
    const float pixel = distance / 30.5f;
    Surfaces surfaces = fromAbove(size, size, 200, pixel,
                                  [=](float x, float) { return x > distance ? step : 0.0f; });
    for (int y = 0; y < size; ++y) // nobody asks about the others
        for (int x = 0; x < size; ++x)
            if (x != size / 2 || std::abs(y - size / 2) > 8)
                surfaces.normal[surfaces.index(x, y)] = glm::vec3(0);
    return surfaces;
}

TraceSettings settingsOf(Integral integral = Integral::cosine) {
    TraceSettings settings;
    settings.radius = 1;
    settings.rays = 512;
    settings.integral = integral;
    return settings;
}

// Over the part of the middle column whose rays stay on the screen.
double occlusionAtCentre(const Reference& reference) {
    double sum = 0;
    for (int y = size / 2 - 8; y <= size / 2 + 8; ++y)
        sum += 1 - static_cast<double>(reference.visibility.at(size / 2, y, 0));
    return sum / 17;
}

// The cosine-weighted share of directions that `blocked` says are: the unit disc by cells
// (Nusselt).
template <typename Blocked>
double occlusionByCells(Blocked&& blocked) {
    constexpr int cells = 2000;
    double sum = 0;
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const double x = (2 * (i + 0.5) / cells) - 1, y = (2 * (j + 0.5) / cells) - 1;
            if (x * x + y * y < 1)
                sum += blocked(x, y, std::sqrt(1 - x * x - y * y)) ? 4.0 / cells / cells / pi : 0;
        }
    return sum;
}

TEST(DepthReference, CurbsSeenFromAboveHideNothing) { // sheet A.3, row "ray-traced I1 / I2"
    const struct {
        float distance, step;
        double cosine, uniform;
    } cases[] = {{0.25f, 0.5f, 0.2695, 0.3317},
                 {0.5f, 0.5f, 0.1310, 0.2059},
                 {0.1f, 0.2f, 0.2761, 0.3491},
                 {0.25f, 2, 0.3420, 0.3750}};
    for (const auto& c : cases) {
        const Surfaces surfaces = curb(c.distance, c.step);
        EXPECT_NEAR(occlusionAtCentre(depthReference(surfaces, settingsOf())), c.cosine, 0.006)
            << c.distance << " " << c.step;
        EXPECT_NEAR(occlusionAtCentre(depthReference(surfaces, settingsOf(Integral::uniform))),
                    c.uniform, 0.006)
            << c.distance << " " << c.step;
    }
}

TEST(DepthReference, LinearFalloffBesideAWall) { // sheet A.2, corner with linear falloff
    EXPECT_NEAR(occlusionAtCentre(depthReference(curb(0.25f, 2), settingsOf(Integral::falloff))),
                0.16821, 0.006);
}

// Of the curb only its upper tenth remains: rays may pass beneath until they meet it from below.
TEST(DepthReference, AThicknessLetsRaysPassBehind) {
    const double d = 0.25, top = 0.5, bottom = 0.4;
    const double expected = occlusionByCells([&](double x, double, double z) {
        if (x <= 0 || z * d > top * x) // passes over
            return false;
        const bool face = z * d >= bottom * x;
        return face ? d / x <= 1 : bottom / z <= 1;
    });
    const double solid = occlusionAtCentre(depthReference(curb(0.25f, 0.5f), settingsOf()));
    const double thin = occlusionAtCentre(depthReference(curb(0.25f, 0.5f), settingsOf(), 0.1));
    EXPECT_NEAR(thin, expected, 0.008);
    EXPECT_GT(solid - thin, 0.03);
    EXPECT_NEAR(occlusionAtCentre(depthReference(curb(0.25f, 0.5f), settingsOf(), 100)), solid,
                1e-6);
}

TEST(DepthReference, APlaneIsOpenAtAnyTilt) {
    for (const double degrees : {0, 30, 60, 80}) {
        const auto slope = static_cast<float>(std::tan(degrees * pi / 180));
        Surfaces surfaces = fromAbove(size, size, 5, 0.005f, [](float, float) { return 0.0f; });
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) { // where the ray meets z = -5 + slope x
                const glm::vec3 ray =
                    surfaces.position(static_cast<float>(x), static_cast<float>(y), 1);
                surfaces.depth[surfaces.index(x, y)] = 5 / (1 + slope * ray.x);
            }
        for (std::size_t i = 0; i < surfaces.normal.size(); ++i)
            surfaces.normal[i] =
                i % 1009 == 0 ? glm::normalize(glm::vec3(-slope, 0, 1)) : glm::vec3(0);
        TraceSettings settings = settingsOf();
        settings.rays = 64;
        const Reference reference = depthReference(surfaces, settings);
        for (const float value : reference.visibility.pixels)
            ASSERT_GE(value, 0.999f) << degrees;
    }
}

TEST(DepthReference, TheStatedErrorIsTheRealOne) {
    TraceSettings settings = settingsOf();
    settings.rays = 200;
    const Surfaces surfaces = curb(0.25f, 2);
    double squares = 0;
    int count = 0;
    for (settings.seed = 1; settings.seed <= 8; ++settings.seed) {
        const Reference reference = depthReference(surfaces, settings);
        const double truth = 1 - 0.3420;
        for (int y = size / 2 - 8; y <= size / 2 + 8; ++y, ++count) {
            const double z =
                (static_cast<double>(reference.visibility.at(size / 2, y, 0)) - truth) /
                static_cast<double>(reference.error.at(size / 2, y, 0));
            squares += z * z;
        }
    }
    EXPECT_GT(squares / count, 0.4);
    EXPECT_LT(squares / count, 2.2); // of Student's t with 7 degrees of freedom: 1.4
}

TEST(DepthReference, TheBentNormalLeansAwayFromTheWall) {
    const Reference reference = depthReference(curb(0.25f, 2), settingsOf());
    EXPECT_LT(reference.bentNormal.at(size / 2, size / 2, 0), -0.15f);
    EXPECT_NEAR(reference.bentNormal.at(size / 2, size / 2, 1), 0, 0.02f);
}

} // namespace
} // namespace obscura
