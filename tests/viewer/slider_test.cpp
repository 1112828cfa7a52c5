#include "viewer/slider.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

TEST(Slider, EveryParameterOfTheTableComesBackFromItsSlider) {
    for (const Technique& technique : techniques())
        for (const Parameter& parameter : technique.parameters) {
            const Scale scale = scaleOf(parameter);
            const double low = parameter.low, high = parameter.high, value = parameter.value;
            EXPECT_EQ(valueAt(scale, 0), low);
            EXPECT_EQ(valueAt(scale, 1), high);
            // To three digits or, where the slider is even, to a five-hundredth of its range.
            const double step = scale.kind == Scale::Kind::even ? (high - low) / 990 : 0;
            EXPECT_NEAR(valueAt(scale, positionOf(scale, value)), value,
                        scale.whole ? 0 : std::max(step, 0.006 * std::abs(value)))
                << technique.id << "." << parameter.name;
            for (double position = 0; position <= 1; position += 0.01)
                EXPECT_TRUE(takes(parameter, static_cast<float>(valueAt(scale, position))))
                    << technique.id << "." << parameter.name << " at " << position;
        }
}

TEST(Slider, IsLogarithmicWhereTheRangeSpansMoreThanTwoDecades) {
    const Scale samples = scaleBetween(1, 16384, true);
    EXPECT_EQ(valueAt(samples, 0.5), 128);
    EXPECT_EQ(scaleBetween(1, 100).kind, Scale::Kind::even);
    EXPECT_EQ(scaleBetween(-1, 1000).kind, Scale::Kind::even);
}

TEST(Slider, WhatReachesFarToBothSidesIsFineAroundZero) {
    const Parameter power{"power", Unit::ratio, "exponent", 1, -64, 64, "test"};
    const Scale scale = scaleOf(power);
    EXPECT_EQ(valueAt(scale, 0.5), 0);
    EXPECT_NEAR(valueAt(scale, 0.75), -valueAt(scale, 0.25), 1e-9);
    EXPECT_GT(positionOf(scale, 1), 0.6);
    EXPECT_LT(positionOf(scale, 1), 0.8);
}

TEST(Slider, ValuesAreReadWithTheirUnits) {
    EXPECT_EQ(valueText(0.025, Unit::ratio), "0.025");
    EXPECT_EQ(valueText(1.5, Unit::metre), "1.5 m");
    EXPECT_EQ(valueText(30, Unit::degree), "30°");
    EXPECT_EQ(valueText(16384, Unit::count), "16384");
    EXPECT_EQ(valueText(static_cast<double>(0.1F), Unit::ratio), "0.1");
}

TEST(Slider, NamesAreReadAsWords) {
    EXPECT_EQ(inWords("radiusMultiplier"), "Radius multiplier");
    EXPECT_EQ(inWords("ray_march"), "Ray march");
}

TEST(Slider, TooltipsGiveMeaningRangeDefaultAndSource) {
    const Parameter bias{"bias", Unit::ratio, "depth that is ignored", 0.02f, 0, 1, "Puri 2024"};
    EXPECT_EQ(meaningOf(bias), "Depth that is ignored\nbias: ratio, 0 to 1, default 0.02\n"
                               "Default from: Puri 2024");
}

} // namespace
} // namespace obscura
