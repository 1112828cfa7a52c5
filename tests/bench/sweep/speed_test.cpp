#include "bench/sweep/speed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::Not;

// A row in whose rounds the anchor takes that time.
SweepRow rowOf(const std::string& view, double anchor, double repeat = 1) {
    SweepRow row;
    row.view = view;
    row.total = {30, 29, 31};
    row.toStarcraft = 30 / anchor;
    row.starcraftRepeat = repeat;
    return row;
}

TEST(Straying, IsOfEachRowFromTheMedianRowOfItsView) {
    SweepRow free = rowOf("b", 1);
    free.total = {0, 0, 0};
    free.toStarcraft = 0;
    const Straying straying =
        strayingOf(std::vector{rowOf("a", 10), rowOf("a", 10), rowOf("a", 8), rowOf("b", 100),
                               rowOf("b", 100), rowOf("b", 130), free});
    EXPECT_DOUBLE_EQ(straying.fastest, 0.8);
    EXPECT_DOUBLE_EQ(straying.slowest, 1.3);
    EXPECT_NEAR(straying.most, 0.3, 1e-12);
    EXPECT_EQ(straying.view, "b");
    EXPECT_NEAR(straying.mean, (0.2 + 0.3) / 6, 1e-12); // what has no anchor does not count
    EXPECT_TRUE(straying.isTooMuch());
    EXPECT_EQ(warningOf(straying),
              "The machine was busy while this was timed: starcraft with 16 samples, which runs "
              "beside every configuration, took 80 to 130 % of its usual time (farthest off in "
              "view b). Times are scaled by it, and are trusted to ±8.3 %, by which it was off on "
              "average: what is nearer than that in time is not told apart.");
}

TEST(Straying, IsOfOddRoundsFromEvenOnesWhereThatIsMore) {
    const Straying straying =
        strayingOf(std::vector{rowOf("a", 10, 0.9), rowOf("a", 10), rowOf("a", 10.2, std::nan("")),
                               rowOf("a", 9.8, 1.01)});
    EXPECT_NEAR(straying.most, 0.1, 1e-12);
    EXPECT_NEAR(straying.mean, (0.1 + 0 + 0.02 + 0.02) / 4, 1e-12);
    EXPECT_THAT(warningOf(straying),
                HasSubstr("odd rounds differ from its even ones by up to 10 %"));
}

TEST(Straying, IsNotWorthAWordBelowOneInTwenty) {
    const Straying calm =
        strayingOf(std::vector{rowOf("a", 100), rowOf("a", 100), rowOf("a", 104.9)});
    EXPECT_FALSE(calm.isTooMuch());
    EXPECT_EQ(warningOf(calm), "");
    EXPECT_EQ(warningOf(strayingOf({})), "");
    const Straying busy =
        strayingOf(std::vector{rowOf("a", 100), rowOf("a", 100), rowOf("a", 105.1)});
    EXPECT_THAT(warningOf(busy), Not(HasSubstr("odd rounds")));
    EXPECT_TRUE(busy.isTooMuch());
}

} // namespace
} // namespace obscura
