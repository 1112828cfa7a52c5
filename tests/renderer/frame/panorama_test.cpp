#include "renderer/frame/panorama.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

constexpr double pi = std::numbers::pi;

// Brute force over the sphere of a panorama's pixels: radiance x GGX's density of half vectors seen
// along the normal x cosine.
double lobeMean(const Image& panorama, glm::dvec3 n, double roughness, int channel) {
    const double a2 = std::pow(roughness, 4);
    double sum = 0, weights = 0;
    for (int y = 0; y < panorama.height; ++y)
        for (int x = 0; x < panorama.width; ++x) {
            const double v = (y + 0.5) / panorama.height;
            const glm::dvec3 d = panoramaDirection((x + 0.5) / panorama.width, v);
            const double cosine = glm::dot(n, d);
            if (cosine <= 0)
                continue;
            const double half2 = (1 + cosine) / 2, spread = half2 * (a2 - 1) + 1;
            const double weight = a2 / (spread * spread) * cosine * std::sin(v * pi);
            sum += weight * static_cast<double>(panorama.at(x, y, channel));
            weights += weight;
        }
    return sum / weights;
}

// A sky that is red towards +x, green towards -z and blue above, none of them linearly.
Image threeLights(int width) {
    Image image{width, width / 2, 3, {}};
    for (int y = 0; y < width / 2; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 d = panoramaDirection((x + 0.5) / width, (y + 0.5) / (width / 2));
            for (const double towards : {d.x, -d.z, d.y})
                image.pixels.push_back(static_cast<float>(0.1 + std::exp(6 * (towards - 1))));
        }
    return image;
}

TEST(Panorama, DirectionsAreAsDeclared) {
    const auto near = [](glm::dvec3 a, glm::dvec3 b) { return glm::distance(a, b) < 1e-12; };
    EXPECT_TRUE(near(panoramaDirection(0.5, 0.5), {0, 0, -1}));
    EXPECT_TRUE(near(panoramaDirection(0.75, 0.5), {1, 0, 0}));
    EXPECT_TRUE(near(panoramaDirection(0.1, 0), {0, 1, 0}));
}

TEST(Reflections, OfOneColourAreThatColour) {
    const Image grey{128, 64, 3, std::vector<float>(std::size_t{128} * 64 * 3, 0.3f)};
    for (const Image& level : reflectionsOf(grey).levels)
        for (const float value : level.pixels)
            ASSERT_NEAR(value, 0.3f, 1e-6f);
}

TEST(Reflections, AreTheLobesMeanAtEachRoughness) {
    const Image panorama = threeLights(256);
    const Reflections reflections = reflectionsOf(panorama);
    ASSERT_EQ(reflections.levels.size(), 4u);
    EXPECT_EQ(reflections.levels[0].pixels, panorama.pixels);
    for (std::size_t k = 1; k < 4; ++k) {
        const Image& level = reflections.levels[k];
        EXPECT_EQ(level.width, 256 >> k);
        EXPECT_EQ(level.height, 128 >> k);
        for (const auto& [across, down] :
             {std::pair(0.5, 0.5), std::pair(0.75, 0.45), std::pair(0.6, 0.3), std::pair(0.2, 0.02),
              std::pair(0.01, 0.97)}) {
            const int x = static_cast<int>(across * level.width),
                      y = static_cast<int>(down * level.height);
            const glm::dvec3 n =
                panoramaDirection((x + 0.5) / level.width, (y + 0.5) / level.height);
            for (int c = 0; c < 3; ++c) {
                const double truth = lobeMean(panorama, n, static_cast<double>(k) / 3, c);
                EXPECT_NEAR(static_cast<double>(level.at(x, y, c)), truth, 0.04 * truth)
                    << "level " << k << " at " << across << ", " << down << ", channel " << c;
            }
        }
    }
}

// What is behind the camera may be as wide as it likes: reflections need 1024 pixels.
TEST(Reflections, OfAWidePanoramaBeginBelowIt) {
    const Reflections reflections = reflectionsOf(threeLights(2048));
    EXPECT_EQ(reflections.sharp, 1);
    EXPECT_EQ(reflections.levels.size(), 7u);
    EXPECT_EQ(reflections.levels[1].width, 1024);
    EXPECT_EQ(reflections.levels.back().width, 32);
}

} // namespace
} // namespace obscura
