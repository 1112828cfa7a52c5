// Against R 4.2.2: cor.test(x, y), cor(x, y, method = "spearman").
#include "tests/error_of.h"

#include "inference/correlation.h"
#include <gtest/gtest.h>

#include <vector>

namespace obscura {
namespace {

// y has two equal values.
const std::vector<double> x = {-3.1, -2.6, -2.4, -1.8, -1.5, -1.2, -0.9, -0.5, -0.3, -0.1},
                          y = {-2.2, -2.9, -1.1, -1.9, -0.4, -1.1, -1.3, 0.2, -0.6, 0.1};

TEST(Correlation, OfLinesIsRs) {
    const auto found = pearson(x, y);
    ASSERT_TRUE(found && found->interval);
    EXPECT_NEAR(found->value, 0.8067748479916528, 1e-12);
    EXPECT_NEAR(found->interval->low, 0.3600336282229574, 1e-9);
    EXPECT_NEAR(found->interval->high, 0.9525417131735018, 1e-9);
    EXPECT_EQ(found->things, 10);
}

TEST(Correlation, OfRanksIsRsWithTies) {
    const auto found = spearman(x, y);
    ASSERT_TRUE(found && found->interval);
    EXPECT_NEAR(found->value, 0.77811909591048, 1e-12);
    EXPECT_NEAR(found->interval->low, 0.19262234542749, 1e-9); // Bonett and Wright, written in R
    EXPECT_NEAR(found->interval->high, 0.95503253883137, 1e-9);
}

TEST(Correlation, OfRanksIsBlindToAnythingThatRises) {
    std::vector<double> cubes;
    for (const double value : x)
        cubes.push_back(value * value * value);
    EXPECT_DOUBLE_EQ(spearman(x, cubes)->value, 1);
    EXPECT_FALSE(spearman(x, cubes)->interval);
    EXPECT_LT(pearson(x, cubes)->value, 0.97);
}

TEST(Correlation, IsAbsentWhereNothingVaries) {
    const std::vector<double> same(x.size(), 2), two = {1, 2};
    EXPECT_FALSE(pearson(x, same));
    EXPECT_FALSE(spearman(same, y));
    EXPECT_FALSE(pearson(two, two));
    const std::vector<double> three = {1, 2, 4}, others = {1, 3, 2};
    EXPECT_TRUE(pearson(three, others) && !pearson(three, others)->interval);
    EXPECT_NE(test::errorOf([&] { pearson(x, two); }), "");
}

} // namespace
} // namespace obscura
