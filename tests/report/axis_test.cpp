#include "report/axis.h"
#include "report/scatter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::ElementsAre;

std::vector<std::string> labelsOf(const Axis& axis) {
    std::vector<std::string> labels;
    for (const Tick& tick : axis.ticks)
        if (!tick.label.empty())
            labels.push_back(tick.label);
    return labels;
}

TEST(Axis, HoldsEveryValueOfALogarithmicRange) {
    const double values[] = {0.2, 30, std::nan(""), 0, -1};
    const Axis axis = logarithmicAxis(values);
    EXPECT_GT(axis.at(0.2), 0);
    EXPECT_LT(axis.at(30), 1);
    EXPECT_NEAR(axis.at(std::sqrt(0.2 * 30)), 0.5, 1e-12);
    EXPECT_EQ(axis.at(0), 0); // no logarithm: on the border
    EXPECT_THAT(labelsOf(axis), ElementsAre("0.2", "0.5", "1", "2", "5", "10", "20"));
}

TEST(Axis, LabelsFewerTicksOfWiderRanges) {
    const double wide[] = {0.001, 100}, narrow[] = {2, 5};
    EXPECT_THAT(labelsOf(logarithmicAxis(wide)),
                ElementsAre("0.001", "0.01", "0.1", "1", "10", "100"));
    EXPECT_THAT(labelsOf(logarithmicAxis(narrow)), ElementsAre("2", "3", "4", "5"));
}

TEST(Axis, MarksTheValuesThemselvesWhereThereIsRoom) {
    const double samples[] = {32, 4, 8, 16, 8}, dense[] = {1, 1.1, 1.2};
    EXPECT_THAT(labelsOf(valueAxis(samples)), ElementsAre("4", "8", "16", "32"));
    EXPECT_EQ(labelsOf(valueAxis(dense)), labelsOf(logarithmicAxis(dense)));
}

TEST(Axis, BeginsALinearRangeAtZero) {
    const double values[] = {0.03, 0.18, std::nan("")}, none[] = {std::nan("")};
    const Axis axis = linearAxis(values);
    EXPECT_EQ(axis.at(0), 0);
    EXPECT_LT(axis.at(0.18), 1);
    EXPECT_THAT(labelsOf(axis), ElementsAre("0.00", "0.05", "0.10", "0.15"));
    EXPECT_GT(linearAxis(none).high, 0);
    EXPECT_GT(logarithmicAxis(none).high, logarithmicAxis(none).low);
}

TEST(NumberPlaces, KeepsNumbersApartAndOffTheBorder) {
    const auto places =
        numberPlaces({{100, 100}, {102, 101}, {104, 102}, {300, 399}, {60, 200}}, 60, 400);
    for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_TRUE(places[i]);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_TRUE(std::abs(places[i]->x - places[j]->x) >= 17 ||
                        std::abs(places[i]->y - places[j]->y) >= 13);
    }
    EXPECT_FALSE(places[0]->far);
    EXPECT_TRUE(places[1]->far);
    EXPECT_FALSE(places[3]); // no room above the border
    ASSERT_TRUE(places[4]);
    EXPECT_GT(places[4]->x, 60); // beside the border
}

} // namespace
} // namespace obscura
