#include "base/random.h"

#include "inference/thurstone_observer.h"
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace obscura {
namespace {

// R 4.2.2: u <- qnorm(.75); pnorm(c(-3, -1, -.5, 0, .5, 1, 2, 3) * u).
TEST(ThurstoneObserver, ChoosesAsRsNormalDistributionSays) {
    const std::pair<double, double> table[] = {
        {-3, 0.0215123953691948}, {-1, 0.25}, {-.5, 0.3679661556049962}, {0, 0.5},
        {.5, 0.6320338443950038}, {1, 0.75},  {2, 0.9113282246738240},   {3, 0.9784876046308052}};
    const ThurstoneObserver observer;
    for (const auto& [jod, share] : table) {
        const PairShares shares = observer.shares(7, 7 + jod, false);
        EXPECT_NEAR(shares.second, share, 1e-12) << jod;
        EXPECT_NEAR(shares.first, 1 - share, 1e-12) << jod;
        EXPECT_EQ(shares.unsure, 0);
    }
}

// R: a <- qnorm(.6) / u; .02 + .96 * pnorm((.8 + a) * u), and of minus that.
TEST(ThurstoneObserver, LapsesAndPlaceShiftTheShares) {
    const ThurstoneObserver observer{.04, .1};
    EXPECT_NEAR(observer.advantage(), 0.375612977161104, 1e-12);
    const PairShares shares = observer.shares(7, 7.8, false);
    EXPECT_NEAR(shares.second, 0.774649558419922, 1e-12);
    EXPECT_NEAR(shares.first, 0.225350441580078, 1e-12);
    EXPECT_NEAR((ThurstoneObserver{0, .1}.shares(8, 8, false).second), 0.6, 1e-12);
}

TEST(ThurstoneObserver, AtTheLimitsNeitherOrOnlyThePlaceCounts) {
    const PairShares lapsed = ThurstoneObserver{1, .3}.shares(2, 9, false);
    EXPECT_DOUBLE_EQ(lapsed.first, 0.5);
    EXPECT_DOUBLE_EQ(lapsed.second, 0.5);
    EXPECT_DOUBLE_EQ((ThurstoneObserver{1, .3}.shares(2, 9, true).unsure), 1. / 3);
    EXPECT_NEAR((ThurstoneObserver{0, .5}.shares(9, 8, false).second), 1, 1e-9);
    EXPECT_NEAR((ThurstoneObserver{0, -.5}.shares(8, 9, false).second), 0, 1e-9);
}

// R: pnorm((-.8 - .5) * u), pnorm((.8 - .5) * u), 1 - 2 * pnorm(-.5 * u); with lapses of .04 and
// the place's a, .04 / 3 + .96 * pnorm((-.8 - a - .5) * u) and .04 / 3 + .96 * pnorm((.8 + a - .5)
// * u).
TEST(ThurstoneObserver, IsUnsureWithinGlennAndDavidsThreshold) {
    const PairShares apart = ThurstoneObserver().shares(7, 7.8, true);
    EXPECT_NEAR(apart.first, 0.190287677747519, 1e-12);
    EXPECT_NEAR(apart.second, 0.580177241139602, 1e-12);
    EXPECT_NEAR(ThurstoneObserver().shares(7, 7, true).unsure, 0.264067688790008, 1e-12);
    const PairShares all = ThurstoneObserver{.04, .1}.shares(7, 7.8, true);
    EXPECT_NEAR(all.first, 0.137364754269724, 1e-12);
    EXPECT_NEAR(all.second, 0.662000525223152, 1e-12);
    EXPECT_DOUBLE_EQ(all.first + all.second + all.unsure, 1);
}

// Two looks, each with its own noise: the better of two images 1 JOD apart wins three of four
// times, within 4.5 standard errors.
TEST(ThurstoneObserver, LooksDifferSoThatOneJodIsThreeQuarters) {
    constexpr int trials = 100'000;
    Random random(1, "looks");
    int won = 0;
    for (int i = 0; i < trials; ++i) {
        const double worse = 8 + lookDeviation * random.normal();
        won += 9 + lookDeviation * random.normal() > worse;
    }
    EXPECT_NEAR(static_cast<double>(won) / trials, 0.75, 4.5 * std::sqrt(.75 * .25 / trials));
}

} // namespace
} // namespace obscura
