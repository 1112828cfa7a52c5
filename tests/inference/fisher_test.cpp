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

double choose(int n, int k) {
    return std::round(std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1)));
}

double weight(int x, int y, int z) { return choose(5, x) * choose(9, y) * choose(3, z); }

double sumOfAllTables(int b, double seen) {
    double total = 0;
    for (int x = 0; x <= 5; ++x)
        for (int y = 0; y <= 9; ++y)
            if (const int z = b - x - y; z >= 0 && z <= 3)
                if (const double table = weight(x, y, z); table <= seen * (1 + 1e-7))
                    total += table;
    return total / choose(17, b);
}

TEST(Fisher, IsTheSumOfAllTablesNoLikelier) {
    for (int x = 0; x <= 5; ++x)
        for (int y = 0; y <= 9; ++y)
            for (int z = x + y == 0 ? 1 : 0; z <= (x + y == 14 ? 2 : 3); ++z)
                EXPECT_NEAR(p({{5 - x, x}, {9 - y, y}, {3 - z, z}}),
                            sumOfAllTables(x + y + z, weight(x, y, z)), 1e-12);
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
