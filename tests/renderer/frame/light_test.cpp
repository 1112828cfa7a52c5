#include "renderer/frame/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

constexpr double pi = std::numbers::pi;

// The shader's sum, in C++.
double irradianceAt(const Irradiance& e, glm::dvec3 n, std::size_t channel) {
    const double basis[9] = {0.282095,
                             0.488603 * n.y,
                             0.488603 * n.z,
                             0.488603 * n.x,
                             1.092548 * n.x * n.y,
                             1.092548 * n.y * n.z,
                             0.315392 * (3 * n.z * n.z - 1),
                             1.092548 * n.x * n.z,
                             0.546274 * (n.x * n.x - n.y * n.y)};
    double sum = 0;
    for (std::size_t i = 0; i < 9; ++i)
        sum += basis[i] * static_cast<double>(e[i][channel]);
    return sum;
}

// Brute force: radiance x cosine over the sphere of a panorama's pixels.
double integrate(const Image& panorama, glm::dvec3 n, int channel) {
    double sum = 0;
    for (int y = 0; y < panorama.height; ++y)
        for (int x = 0; x < panorama.width; ++x) {
            const double phi = ((x + 0.5) / panorama.width - 0.5) * 2 * pi;
            const double theta = (y + 0.5) / panorama.height * pi;
            const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                               -std::sin(theta) * std::cos(phi));
            sum += static_cast<double>(panorama.at(x, y, channel)) * std::max(glm::dot(n, d), 0.0) *
                   std::sin(theta) * 2 * pi * pi / (panorama.width * panorama.height);
        }
    return sum;
}

TEST(IrradianceTest, OfAConstantSkyIsPiTimesItsRadiance) {
    Image white{64, 32, 3, std::vector<float>(64 * 32 * 3, 2.0f)};
    const Irradiance e = irradianceOf(white);
    for (const glm::dvec3 n : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(0.6, 0, 0.8)})
        EXPECT_NEAR(irradianceAt(e, n, 0), 2 * pi, 0.01);
}

// Nine coefficients hold any cosine-convolved environment within 9 % at worst (Ramamoorthi and
// Hanrahan 2001, section 3.3).
TEST(IrradianceTest, OfTheBuiltInSkyIsItsIntegral) {
    const Image sky = skyPanorama(Sky{});
    const Irradiance e = irradianceOf(sky);
    for (const glm::dvec3 n : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0),
                               glm::normalize(glm::dvec3(1, 1, -1))})
        for (int c = 0; c < 3; ++c) {
            const double truth = integrate(sky, n, c);
            EXPECT_NEAR(irradianceAt(e, n, static_cast<std::size_t>(c)), truth, 0.09 * truth);
        }
}

TEST(SunTest, PointsWhereAzimuthAndElevationSay) {
    const glm::vec3 up = directionOf({0, 90, {}}), front = directionOf({0, 0, {}}),
                    right = directionOf({90, 0, {}});
    EXPECT_NEAR(glm::distance(up, glm::vec3(0, 1, 0)), 0, 1e-6f);
    EXPECT_NEAR(glm::distance(front, glm::vec3(0, 0, 1)), 0, 1e-6f);
    EXPECT_NEAR(glm::distance(right, glm::vec3(1, 0, 0)), 0, 1e-6f);
}

} // namespace
} // namespace obscura
