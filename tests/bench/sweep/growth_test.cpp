#include "bench/sweep/growth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::ElementsAre;

// Major half axis in astronomical units, period in years (NASA's planetary fact sheet).
TEST(Growth, FindsKeplersThirdLaw) {
    std::vector<GrowthRow> rows;
    for (const auto& [axis, period] : {std::pair(30.07, 164.8),
                                       {0.387, 0.2408},
                                       {0.723, 0.6152},
                                       {1.0, 1.0},
                                       {1.524, 1.881},
                                       {5.204, 11.862},
                                       {9.582, 29.457},
                                       {19.20, 84.01}})
        rows.push_back({"planets", "radius", axis, period});
    const std::vector<Growth> growth = growthOf(rows);
    ASSERT_EQ(growth.size(), 1u);
    EXPECT_EQ(growth[0].rows.size(), 8u);
    EXPECT_EQ(growth[0].rows.front().value, 0.387);
    EXPECT_NEAR(growth[0].slope, 1.5, 0.001);
    EXPECT_NEAR(growth[0].factor, 1, 0.002);
    EXPECT_NEAR(growth[0].r2, 1, 1e-6);
}

TEST(Growth, FindsPowerLawsOfEachConfigurationAndAxis) {
    std::vector<GrowthRow> rows;
    for (const double value : {2.0, 3.0, 7.0, 20.0})
        for (const double slope : {-1.0, 0.0, 0.37, 2.0})
            rows.push_back({std::to_string(slope), "samples", value, 0.2 * std::pow(value, slope)});
    for (const Growth& growth : growthOf(rows)) {
        EXPECT_NEAR(growth.slope, std::stod(growth.configuration), 1e-12);
        EXPECT_NEAR(growth.factor, 0.2, 1e-12);
    }
    EXPECT_THAT(growthOf(rows), testing::SizeIs(4));
}

TEST(Growth, LeavesOutWhatHasNoLogarithm) {
    const double nan = std::nan("");
    const auto growth = growthOf({{"a", "silhouettes", 0, 5},
                                  {"a", "silhouettes", 1, 0},
                                  {"a", "silhouettes", nan, 1},
                                  {"a", "silhouettes", 1, nan},
                                  {"a", "silhouettes", 1, 3},
                                  {"b", "radius", 1, 3},
                                  {"b", "radius", 1, 4},
                                  {"c", "radius", -1, 4}});
    ASSERT_EQ(growth.size(), 2u);
    EXPECT_EQ(growth[0].rows.size(), 1u);
    EXPECT_TRUE(std::isnan(growth[0].slope)); // of one value
    EXPECT_TRUE(std::isnan(growth[1].slope)); // of two equal values
    EXPECT_THAT(axesOf(growth), ElementsAre("silhouettes", "radius"));
}

} // namespace
} // namespace obscura
