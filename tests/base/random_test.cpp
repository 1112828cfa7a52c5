#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace obscura {
namespace {

using Block = std::array<std::uint32_t, 4>;

// Known answers published with Random123 1.14 (kat_vectors, philox4x32 10).
TEST(Philox, GivesTheKnownAnswers) {
    EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}),
              (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
              (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, RepeatsForTheSameSeedAndPurposeOnly) {
    Random a(1, "order"), b(1, "order"), otherSeed(2, "order"), otherPurpose(1, "choice");
    const std::uint32_t first = a.bits();
    EXPECT_EQ(first, b.bits());
    EXPECT_NE(first, otherSeed.bits());
    EXPECT_NE(first, otherPurpose.bits());
}

// Every bound below is six standard errors of the mean of n draws: one in 10^9 by chance, and the
// seed is fixed.
TEST(Random, DistributionsHaveTheirMoments) {
    constexpr int n = 200000;
    Random random(3, "moments");
    double uniform = 0, normal = 0, square = 0, exponential = 0;
    for (int i = 0; i < n; ++i) {
        uniform += random.uniform();
        const double z = random.normal();
        normal += z;
        square += z * z;
        exponential += random.exponential();
    }
    const double error = 6 / std::sqrt(n);
    EXPECT_NEAR(uniform / n, 0.5, error * std::sqrt(1.0 / 12));
    EXPECT_NEAR(normal / n, 0, error);
    EXPECT_NEAR(square / n, 1, error * std::sqrt(2.0));
    EXPECT_NEAR(exponential / n, 1, error);
}

TEST(Random, ShufflesIntoEveryOrderEquallyOften) {
    std::map<std::vector<int>, int> counts;
    Random random(4, "shuffle");
    constexpr int n = 24000;
    for (int i = 0; i < n; ++i) {
        std::vector<int> items{1, 2, 3, 4};
        random.shuffle(items);
        ++counts[items];
    }
    ASSERT_EQ(counts.size(), 24u);
    double chiSquare = 0;
    for (const auto& [order, count] : counts)
        chiSquare += std::pow(count - n / 24.0, 2) / (n / 24.0);
    EXPECT_LT(chiSquare, 49.7); // chi-square with 23 degrees of freedom: p = 0.001
}

TEST(Random, BelowReachesAllAndNoMore) {
    Random random(5, "below");
    std::array<int, 7> counts{};
    for (int i = 0; i < 7000; ++i)
        ++counts.at(random.below(7));
    EXPECT_GT(*std::min_element(counts.begin(), counts.end()), 850); // 5 standard deviations
}

} // namespace
} // namespace obscura
