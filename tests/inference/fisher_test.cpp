#include "inference/fisher.h"
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

double p(const std::vector<Votes>& conditions) { return fisherP(conditions).value(); }

// R 4.2.2, fisher.test(cbind(a, b), workspace = 2e8).
TEST(Fisher, IsThatOfR) {
    EXPECT_NEAR(p({{3, 0}, {0, 4}}), 0.0285714285714286, 1e-14);
    EXPECT_NEAR(p({{18, 18}, {11, 25}, {18, 18}}), 0.158727, 5e-7);
    EXPECT_NEAR(p({{18, 18}, {11, 25}, {16, 20}, {7, 1}}), 0.0247081353998966, 1e-12);
    EXPECT_NEAR(p({{18, 18}, {14, 22}, {11, 25}, {16, 20}, {11, 25}, {18, 18}, {21, 15}}),
                0.139239638366917, 1e-11);
}

// Against going through all tables of three conditions.
TEST(Fisher, IsTheSumOfAllTablesNoLikelier) {
    const auto choose = [](int n, int k) {
        return std::round(
            std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1)));
    };
    const int n[] = {5, 9, 3};
    for (int x = 0; x <= n[0]; ++x)
        for (int y = 0; y <= n[1]; ++y)
            for (int z = 0; z <= n[2]; ++z) {
                const int sum = x + y + z;
                if (sum == 0 || sum == 17)
                    continue;
                const double seen = choose(n[0], x) * choose(n[1], y) * choose(n[2], z);
                double total = 0;
                for (int i = 0; i <= n[0]; ++i)
                    for (int j = 0; j <= n[1]; ++j)
                        if (const int k = sum - i - j; k >= 0 && k <= n[2]) {
                            const double other =
                                choose(n[0], i) * choose(n[1], j) * choose(n[2], k);
                            total += other <= seen * (1 + 1e-7) ? other : 0;
                        }
                EXPECT_NEAR(p({{n[0] - x, x}, {n[1] - y, y}, {n[2] - z, z}}),
                            total / choose(17, sum), 1e-12);
            }
}

// The second and third by Python's fractions, for R has ten digits: 1.98999514009857e-18.
TEST(Fisher, KeepsItsDigitsInTheTail) {
    // One table of C(1000, 500), and its mirror image.
    const double logP = std::log(2) + 2 * std::lgamma(501) - std::lgamma(1001);
    EXPECT_NEAR(std::log(p({{500, 0}, {0, 500}})), logP, 1e-10);
    EXPECT_NEAR(p({{90, 10}, {60, 40}, {30, 70}}) / 1.98999514009189992e-18, 1, 1e-11);
    EXPECT_NEAR(p({{1, 299}, {290, 10}}) / 8.13220953501119679e-159, 1, 1e-11);
}

TEST(Fisher, IsAbsentWhereNothingVariesOrTablesAreTooMany) {
    EXPECT_FALSE(fisherP({}));
    EXPECT_FALSE(fisherP(std::vector<Votes>{{3, 4}, {0, 0}}));
    EXPECT_FALSE(fisherP(std::vector<Votes>{{3, 0}, {9, 0}}));
    EXPECT_FALSE(fisherP(std::vector<Votes>{{1'000'000'000, 3}, {5, 1'000'000'000}}));
    EXPECT_EQ(p({{1, 0}, {0, 1}, {0, 0}}), 1);
}

} // namespace
} // namespace obscura
