#include "bench/measure/picture_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

constexpr int width = 96, height = 64;

// A grey surface in the left half, the sky in the right one.
Image8 picture(std::uint8_t surface, std::uint8_t sky) {
    Image8 image{width, height, 3, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.pixels.insert(image.pixels.end(), 3, x < width / 2 ? surface : sky);
    return image;
}

std::vector<bool> surfaces() {
    std::vector<bool> shown;
    for (int i = 0; i < width * height; ++i)
        shown.push_back(i % width < width / 2);
    return shown;
}

TEST(LitError, CountsTheBackgroundOnlyWhereAPersonSeesIt) {
    const Display& display = displays().front();
    const PictureError sky = litError(picture(90, 160), picture(90, 200), surfaces(), display);
    EXPECT_EQ(sky.rmse, 0);
    EXPECT_EQ(sky.bias, 0);
    EXPECT_LT(sky.jod, 9.9);
    EXPECT_EQ(litError(picture(90, 200), picture(90, 200), surfaces(), display).jod, 10);
}

TEST(LitError, PredictsJodOnTheDisplayThatIsAskedFor) {
    Display sunlit = displays().front();
    sunlit.ambient = 20000; // which washes the picture out
    const Image8 image = picture(40, 60), truth = picture(50, 60);
    EXPECT_GT(litError(image, truth, surfaces(), sunlit).jod,
              litError(image, truth, surfaces(), displays().front()).jod + 0.1);
}

TEST(VisibilityError, HasNoJod) {
    const Image image{8, 8, 1, std::vector<float>(64, 0.5f)};
    EXPECT_TRUE(std::isnan(visibilityError(image, image, std::vector<bool>(64, true)).jod));
}

} // namespace
} // namespace obscura
