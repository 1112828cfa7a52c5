#include "bench/sweep/pareto.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <set>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

using Points = std::vector<ParetoPoint>;
const double nan = std::nan("");

TEST(ParetoFront, OfNothingIsNothing) { EXPECT_THAT(paretoFront(Points{}), IsEmpty()); }

TEST(ParetoFront, LeavesOutWhatIsSlowerAndWorse) {
    const Points points = {{3, 1, "c"}, {1, 3, "a"}, {2, 2, "b"}, {3, 3, "d"}, {2.5, 2, "e"}};
    EXPECT_THAT(paretoFront(points), ElementsAre(1, 2, 0));
}

TEST(ParetoFront, KeepsEqualsInTheOrderOfTheirNames) {
    const Points points = {{1, 1, "b"}, {1, 1, "a"}, {1, 2, "c"}, {2, 1, "d"}};
    EXPECT_THAT(paretoFront(points), ElementsAre(1, 0));
}

TEST(ParetoFront, LeavesOutWhatIsNotANumber) {
    const Points points = {{nan, 0, "a"}, {0, nan, "b"}, {1, 1, "c"}};
    EXPECT_THAT(paretoFront(points), ElementsAre(2));
    EXPECT_FALSE(dominatedBy(points, 0));
    EXPECT_FALSE(dominatedBy(points, 1));
    EXPECT_FALSE(dominatedBy(points, 2));
}

TEST(NearFront, IsWhatIsDominatedByLessThanTimesAreUncertain) {
    const Points points = {{1, 3, "a"},   {1.2, 3, "b"}, {1.22, 3, "c"}, {0, 4, "free"},
                           {0.1, 4, "d"}, {nan, 1, "e"}, {2, 2, "f"}};
    EXPECT_THAT(nearFront(points, 0.1), ElementsAre(1)); // 1.1 each way is 1.21
    EXPECT_THAT(nearFront(points, 0), IsEmpty());
}

// By another definition: each time is anywhere between its ends, and the point is on the front of
// some such times. Every choice of ends is tried.
TEST(NearFront, IsTheFrontOfSomeTimesWithinTheUncertainty) {
    std::mt19937 random(5);
    std::uniform_real_distribution<> one(0.5, 1.5);
    std::size_t found = 0;
    for (int round = 0; round < 100; ++round) {
        Points points(7);
        for (ParetoPoint& point : points)
            point = {one(random), std::round(4 * one(random)), ""};
        std::set<std::size_t> sometimes;
        for (unsigned slow = 0; slow < 1u << points.size(); ++slow) {
            Points shifted = points;
            for (std::size_t i = 0; i < points.size(); ++i)
                shifted[i].milliseconds *= slow >> i & 1u ? 1.2 : 1 / 1.2;
            for (const std::size_t i : paretoFront(shifted))
                sometimes.insert(i);
        }
        for (const std::size_t i : paretoFront(points))
            sometimes.erase(i);
        const auto near = nearFront(points, 0.2);
        EXPECT_EQ(std::set(near.begin(), near.end()), sometimes);
        found += near.size();
    }
    EXPECT_GT(found, 50u);
}

TEST(DominatedBy, NamesTheLeastErrorForNoMoreTime) {
    const Points points = {{1, 3, "a"}, {2, 2, "b"}, {3, 2.5, "c"}, {3, 4, "d"}, {4, 1, "e"}};
    EXPECT_EQ(dominatedBy(points, 3), 1u);
    EXPECT_EQ(dominatedBy(points, 2), 1u);
    EXPECT_FALSE(dominatedBy(points, 4));
}

// The front by another definition: the smallest set of points such that each point outside is
// dominated by one inside. Every subset is tried.
std::set<std::size_t> smallestDominatingSet(const Points& points) {
    unsigned best = ~0u;
    for (unsigned subset = 0; subset < 1u << points.size(); ++subset) {
        bool covers = true;
        for (std::size_t i = 0; i < points.size() && covers; ++i) {
            covers = subset >> i & 1u;
            for (std::size_t j = 0; j < points.size() && !covers; ++j)
                covers = (subset >> j & 1u) && points[j].milliseconds <= points[i].milliseconds &&
                         points[j].error <= points[i].error &&
                         (points[j].milliseconds != points[i].milliseconds ||
                          points[j].error != points[i].error);
        }
        if (covers && (best == ~0u || std::popcount(subset) < std::popcount(best)))
            best = subset;
    }
    std::set<std::size_t> indices;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (best >> i & 1u)
            indices.insert(i);
    return indices;
}

TEST(ParetoFront, IsTheSmallestSetThatDominatesTheRest) {
    std::mt19937 random(1);
    for (int round = 0; round < 60; ++round) {
        Points points;
        for (int i = 0; i < 9; ++i) // few values, so that ties are common
            points.push_back({static_cast<double>(random() % 5), static_cast<double>(random() % 5),
                              std::string(1, static_cast<char>('a' + i))});
        const auto front = paretoFront(points);
        EXPECT_EQ(std::set(front.begin(), front.end()), smallestDominatingSet(points));
        for (std::size_t k = 1; k < front.size(); ++k)
            EXPECT_LE(points[front[k - 1]].milliseconds, points[front[k]].milliseconds);
    }
}

} // namespace
} // namespace obscura
