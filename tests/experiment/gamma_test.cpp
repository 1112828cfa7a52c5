#include "experiment/gamma.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

std::vector<LuminanceReading> display(double gamma, double white, double black) {
    std::vector<LuminanceReading> readings;
    for (int code = 0; code <= 255; code += code == 240 ? 15 : 16)
        readings.push_back({code, black + white * std::pow(code / 255.0, gamma)});
    return readings;
}

TEST(Gamma, IsFoundAgain) {
    for (const double gamma : {1.0, 1.8, 2.2, 2.4}) {
        const auto fit = fitGamma(display(gamma, 120, 0.3));
        ASSERT_TRUE(fit);
        EXPECT_NEAR(fit->gamma, gamma, 1e-9);
        EXPECT_NEAR(fit->scale, 120, 1e-6);
        EXPECT_EQ(fit->black, 0.3);
        EXPECT_NEAR(fit->at(255), 120.3, 1e-6);
    }
}

// sRGB's own curve is not a power; the best one for these patches is near 2.2.
TEST(Gamma, OfAnSrgbDisplayIsNear22) {
    std::vector<LuminanceReading> readings;
    for (int code = 16; code <= 240; code += 16) {
        const double v = code / 255.0;
        readings.push_back(
            {code, 100 * (v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4))});
    }
    EXPECT_NEAR(fitGamma(readings)->gamma, 2.2, 0.15);
}

TEST(Gamma, ThatReadingsDoNotDecideIsNone) {
    EXPECT_FALSE(fitGamma({}));
    EXPECT_FALSE(fitGamma({{0, 1}, {255, 100}}));
    EXPECT_FALSE(fitGamma({{128, 20}, {128, 21}})) << "one code twice";
    EXPECT_FALSE(fitGamma({{16, 100}, {255, 1}})) << "the other way round";
    EXPECT_FALSE(fitGamma({{0, 50}, {16, 40}, {32, 30}})) << "none above black";
    EXPECT_TRUE(fitGamma({{128, 20}, {255, 100}}));
}

TEST(Gamma, OfAMatchIsThatOfHalfTheLight) {
    EXPECT_NEAR(gammaOfMatch(128), 1.0057, 1e-3); // ln(1/2) / ln(128/255)
    EXPECT_NEAR(gammaOfMatch(186), 2.197, 1e-3);
    EXPECT_NEAR(std::pow(150 / 255.0, gammaOfMatch(150)), 0.5, 1e-12);
}

} // namespace
} // namespace obscura
