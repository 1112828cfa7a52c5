#include "base/error.h"

#include "inference/robust.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

// Response times with ties and wild ones, in ms. R 4.2.2: mean, sd, median, mad,
// exp(mean(log(x))), mean(x, trim = .1), quantile(x, type = 7).
const std::vector<double> times = {1850, 420,     1300, 1300, 990,  2210, 121,
                                   1640, 41250.5, 1300, 760,  1510, 1105, 15020,
                                   1730, 880,     2950, 640,  1999, 1422, 187};

TEST(Robust, SummaryIsThatOfR) {
    const auto found = summary(times);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->count, 21U);
    EXPECT_NEAR(found->mean, 3837.35714285714, 1e-9);
    EXPECT_NEAR(found->sd.value(), 9105.55095414722, 1e-9);
    EXPECT_EQ(found->median, 1300);
    EXPECT_NEAR(found->mad, 800.604, 1e-9);
    EXPECT_NEAR(found->geometricMean.value(), 1381.78417283738, 1e-9);
    EXPECT_NEAR(found->trimmedMean, 1412.11764705882, 1e-9);
    EXPECT_THAT(quantiles(times, std::vector{.05, .25, .75, .95, 0., 1.}),
                Pointwise(DoubleNear(1e-9), {187.0, 880.0, 1850.0, 15020.0, 121.0, 41250.5}));
}

std::vector<int> flagged(const std::vector<double>& values, FlagRule rule) {
    std::vector<int> rows;
    const std::vector<bool> found = flags(values, rule);
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i])
            rows.push_back(static_cast<int>(i) + 1);
    return rows;
}

TEST(Robust, FlagsTheRowsThatRDoes) {
    EXPECT_THAT(flagged(times, FlagRule::fast), ElementsAre(7, 21));
    EXPECT_THAT(flagged(times, FlagRule::sd), ElementsAre(9));
    EXPECT_THAT(flagged(times, FlagRule::sdLog), ElementsAre());
    EXPECT_THAT(flagged(times, FlagRule::mad), ElementsAre(9, 14));
    EXPECT_THAT(flagged(times, FlagRule::madLog), ElementsAre(7, 9, 14, 21));
    EXPECT_THAT(flagged(times, FlagRule::tukey), ElementsAre(9, 14));
    const std::vector<double> one = {1000}, none, same = {1000, 1000, 1000};
    for (const FlagRule rule : {FlagRule::fast, FlagRule::sd, FlagRule::sdLog, FlagRule::mad,
                                FlagRule::madLog, FlagRule::tukey}) {
        EXPECT_THAT(flagged(one, rule), ElementsAre());
        EXPECT_THAT(flagged(none, rule), ElementsAre());
        EXPECT_THAT(flagged(same, rule), ElementsAre());
    }
}

// Two of the three are the same, so that the mad is 0: R flags the third.
TEST(Robust, FlagsWhatDiffersFromValuesThatAreTheSame) {
    EXPECT_THAT(flagged({900, 900, 901}, FlagRule::mad), ElementsAre(3));
    EXPECT_THAT(flagged({900, 900, 901}, FlagRule::madLog), ElementsAre(3));
}

TEST(Robust, FlagsTimesThatCannotBeOnTheLogScale) {
    const std::vector<double> impossible = {0, 900, -5, 1000, 1100};
    EXPECT_THAT(flagged(impossible, FlagRule::madLog), ElementsAre(1, 3));
    EXPECT_THAT(flagged(impossible, FlagRule::sdLog), ElementsAre(1, 3));
    EXPECT_THAT(flagged({0, 0}, FlagRule::madLog), ElementsAre(1, 2));
    std::vector<double> more = {-5, 0};
    more.insert(more.end(), times.begin(), times.end());
    EXPECT_THAT(flagged(more, FlagRule::madLog), ElementsAre(1, 2, 9, 11, 16, 23));
    EXPECT_THAT(flagged(more, FlagRule::fast), ElementsAre(1, 2, 9, 23));
    EXPECT_FALSE(summary(impossible)->geometricMean);
}

TEST(Robust, SummaryOfFewValues) {
    EXPECT_FALSE(summary({}));
    EXPECT_TRUE(quantiles({}, std::vector{0.5}).empty());
    const auto one = summary(std::vector{7.0});
    EXPECT_FALSE(one->sd);
    EXPECT_TRUE(one->mean == 7 && one->median == 7 && one->mad == 0 && one->trimmedMean == 7);
    EXPECT_THROW(summary(std::vector{1.0, std::nan("")}), Error);
    EXPECT_THROW(flags(std::vector{1.0, HUGE_VAL}, FlagRule::sd), Error);
}

} // namespace
} // namespace obscura
