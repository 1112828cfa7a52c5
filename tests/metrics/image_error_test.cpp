#include "metrics/image_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

std::vector<bool> everywhere(const Image& image) {
    return std::vector<bool>(image.pixels.size(), true);
}

template <typename Function>
Image image(int width, int height, Function value) {
    Image result{width, height, 1, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            result.pixels.push_back(static_cast<float>(value(x, y)));
    return result;
}

TEST(ImageError, HandComputed) {
    const Image reference{4, 1, 1, {1, 0.5f, 0.5f, 0}}, found{4, 1, 1, {0.5f, 0.5f, 0.75f, 1}};
    // The last pixel is empty. Too dark by 0.5, 0 and -0.25.
    const ImageError error = imageError(found, reference, {true, true, true, false});
    EXPECT_DOUBLE_EQ(error.rmse, std::sqrt((0.25 + 0.0625) / 3));
    EXPECT_DOUBLE_EQ(error.bias, 0.25 / 3);
    EXPECT_DOUBLE_EQ(error.biasFree, std::sqrt(0.3125 / 3 - 0.0625 / 9));
    EXPECT_DOUBLE_EQ(error.meanOcclusion, (0.5 + 0.5 + 0.25) / 3);
    EXPECT_TRUE(std::isnan(error.ssim)); // no window fits
}

// Wang et al. 2004, equation 13, on one window.
TEST(Ssim, HandComputed) {
    constexpr double c1 = 1e-4, c2 = 9e-4;
    const Image dark = image(11, 11, [](int, int) { return 0.25; }),
                light = image(11, 11, [](int, int) { return 0.75; });
    EXPECT_DOUBLE_EQ(structuralSimilarity(dark, dark, everywhere(dark)), 1);
    EXPECT_NEAR(structuralSimilarity(dark, light, everywhere(dark)),
                (2 * 0.25 * 0.75 + c1) / (0.25 * 0.25 + 0.75 * 0.75 + c1), 1e-12);

    // A bright centre on black: with w its weight, the mean is w and the variance w - w^2.
    const Image spot = image(11, 11, [](int x, int y) { return x == 5 && y == 5; }),
                black = image(11, 11, [](int, int) { return 0; });
    double sum = 0;
    for (int i = -5; i <= 5; ++i)
        sum += std::exp(-i * i / 4.5);
    const double w = 1 / (sum * sum);
    EXPECT_NEAR(structuralSimilarity(spot, black, everywhere(spot)),
                c1 / (w * w + c1) * c2 / (w - w * w + c2), 1e-9);

    // Its negative: equal variances, covariance their negative.
    const Image hole = image(11, 11, [](int x, int y) { return x != 5 || y != 5; });
    const double v = w - w * w;
    EXPECT_NEAR(structuralSimilarity(spot, hole, everywhere(spot)),
                (2 * w * (1 - w) + c1) * (c2 - 2 * v) /
                    ((w * w + (1 - w) * (1 - w) + c1) * (2 * v + c2)),
                1e-9);
}

// Every window on its own, by the definition, with no separable filter.
TEST(Ssim, EqualsTheDefinitionWindowByWindow) {
    constexpr int width = 17, height = 14;
    const Image a = image(width, height, [](int x, int y) { return (x * 7 + y * 5) % 11 / 11.0; }),
                b = image(width, height, [](int x, int y) { return (x * 3 + y * y) % 7 / 7.0; });
    double total = 0;
    int windows = 0;
    for (int y = 5; y < height - 5; ++y)
        for (int x = 5; x < width - 5; ++x) {
            double weight = 0, ma = 0, mb = 0, va = 0, vb = 0, covariance = 0;
            const auto sum = [&](auto visit) {
                for (int j = -5; j <= 5; ++j)
                    for (int i = -5; i <= 5; ++i)
                        visit(std::exp(-(i * i + j * j) / 4.5),
                              static_cast<double>(a.at(x + i, y + j, 0)),
                              static_cast<double>(b.at(x + i, y + j, 0)));
            };
            sum([&](double w, double p, double q) { weight += w, ma += w * p, mb += w * q; });
            ma /= weight, mb /= weight;
            sum([&](double w, double p, double q) {
                va += w * (p - ma) * (p - ma) / weight, vb += w * (q - mb) * (q - mb) / weight;
                covariance += w * (p - ma) * (q - mb) / weight;
            });
            total += (2 * ma * mb + 1e-4) * (2 * covariance + 9e-4) /
                     ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
            ++windows;
        }
    EXPECT_NEAR(structuralSimilarity(a, b, everywhere(a)), total / windows, 1e-9);
}

TEST(Ssim, LeavesOutWindowsAroundEmptyPixels) {
    const Image a = image(30, 11, [](int x, int) { return x < 15 ? 0.5 : 1; }),
                b = image(30, 11, [](int x, int) { return x < 15 ? 0.25 : 1; });
    std::vector<bool> left(a.pixels.size(), false);
    left[5 * 30 + 6] = true; // its window ends at x = 11
    EXPECT_NEAR(structuralSimilarity(a, b, left), (2 * 0.5 * 0.25 + 1e-4) / (0.25 + 0.0625 + 1e-4),
                1e-9);
    EXPECT_TRUE(std::isnan(structuralSimilarity(a, b, std::vector<bool>(a.pixels.size(), false))));
}

} // namespace
} // namespace obscura
