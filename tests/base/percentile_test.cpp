#include "base/percentile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

// R: quantile(c(7, 1, 3, 10), c(0, .05, .25, .5, .95, 1), type = 7)
TEST(Percentile, IsTheOneOfR) {
    const std::vector<double> values{7, 1, 3, 10};
    EXPECT_DOUBLE_EQ(percentile(values, 0), 1);
    EXPECT_DOUBLE_EQ(percentile(values, 0.05), 1.3);
    EXPECT_DOUBLE_EQ(percentile(values, 0.25), 2.5);
    EXPECT_DOUBLE_EQ(percentile(values, 0.5), 5);
    EXPECT_DOUBLE_EQ(percentile(values, 0.95), 9.55);
    EXPECT_DOUBLE_EQ(percentile(values, 1), 10);
}

TEST(Percentile, OfOneValueIsThatValue) { EXPECT_EQ(percentile({4}, 0.95), 4); }

TEST(Percentile, DoesNotInventOne) {
    EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
    EXPECT_TRUE(std::isnan(percentile({1, std::nan(""), 2}, 0.5)));
}

} // namespace
} // namespace obscura
