#include "viewer/meter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

// A plain picture of light `radiance`, as the composite would show it.
Image8 shown(double radiance, Curve curve, double exposure) {
    double light = radiance * std::exp2(exposure);
    if (curve == Curve::reinhard)
        light /= 1 + light;
    const float code = srgbFromLinear(static_cast<float>(std::min(light, 1.0))) * 255;
    return {8, 4, 3, std::vector<std::uint8_t>(96, static_cast<std::uint8_t>(std::lround(code)))};
}

TEST(Meter, BringsAPlainPictureToMiddleGrey) {
    for (const Curve curve : {Curve::clamp, Curve::reinhard})
        for (const double radiance : {0.01, 0.045, 0.18, 0.72})
            for (const double exposure : {-1.0, 0.0})
                EXPECT_NEAR(meteredExposure(shown(radiance, curve, exposure), curve, exposure),
                            std::log2(0.18 / radiance), 0.26) // half of a half stop
                    << radiance << " at " << exposure;
}

TEST(Meter, StaysInRangeWhereNothingIsSeen) {
    EXPECT_EQ(meteredExposure({8, 4, 3, std::vector<std::uint8_t>(96, 0)}, Curve::clamp, 6), 8);
    EXPECT_EQ(meteredExposure({}, Curve::clamp, 1.5), 1.5);
}

} // namespace
} // namespace obscura
