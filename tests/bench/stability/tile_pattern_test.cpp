#include "base/random.h"
#include "bench/stability/tile_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obscura {
namespace {

constexpr int width = 96, height = 60;

// Diagonals of different visibility, a wave of so many pixels, and noise without order.
Image synthetic(double wave, int period, double noise) {
    Image image{width, height, 1, {}};
    Random random(7, "grain");
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double phase = 2 * std::numbers::pi * (x + y) / period;
            image.pixels.push_back(static_cast<float>(
                0.3 + 0.004 * (x - y) + wave * std::cos(phase) + noise * random.normal()));
        }
    return image;
}

TilePattern found(const Image& image, int period) {
    const Selection all(image.pixels.size(), true);
    return tilePattern(image, withDiagonalsLevelled(image, all), all, period);
}

TEST(TilePattern, FindsTheEnergyOfAWave) {
    const TilePattern pattern = found(synthetic(0.02, 4, 0), 4);
    EXPECT_NEAR(pattern.amplitude, 0.02 / std::numbers::sqrt2, 1e-4);
    EXPECT_NEAR(pattern.share, 1, 3e-3); // short diagonals take some of it for their level
}

TEST(TilePattern, TellsAWaveFromNoise) {
    const TilePattern pattern = found(synthetic(0.02, 3, 0.02), 3);
    EXPECT_NEAR(pattern.amplitude, 0.02 / std::numbers::sqrt2, 1e-3);
    EXPECT_NEAR(pattern.share, 1.0 / 3, 0.02); // 0.02^2 / 2 of 0.02^2 / 2 + 0.02^2
}

TEST(TilePattern, IsNotDeceivedByOtherPeriodsAndByDiagonals) {
    EXPECT_LT(found(synthetic(0.02, 3, 0), 4).amplitude, 1e-3);
    EXPECT_LT(found(synthetic(0, 4, 0), 4).amplitude, 1e-6);
    EXPECT_LT(found(synthetic(0, 4, 0.02), 4).share, 0.01);
}

} // namespace
} // namespace obscura
