#include "inference/tails.h"
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

#define EXPECT_SAME(found, expected) EXPECT_NEAR((found) / (expected), 1, 1e-10)

// Of R 4.2.2, with log.p = TRUE.
TEST(Tails, AreThoseOfRDownToTheSmallestNumbers) {
    EXPECT_SAME(2 * binomialLower(0, 1000, 0.5), 1.86652723700646e-301);
    EXPECT_SAME(2 * binomialLower(400, 1000, 0.5), 2.72846415606603e-10);
    EXPECT_SAME(2 * binomialLower(9000, 20'000, 0.5), 1.9540827705829e-45);
    EXPECT_SAME(2 * binomialLower(499'500'000, 1'000'000'000, 0.5), 1.79748151357573e-219);
    EXPECT_SAME(binomialUpper(701, 1000, 0.4), 1.66753453621557e-82); // pbinom(700, lower = FALSE)
    EXPECT_SAME(chiSquareP(1300), 1.13037284414929e-284);
    EXPECT_SAME(chiSquareP(1300, 2), 5.11195194865116e-283);
    EXPECT_SAME(chiSquareP(1300, 6.843), 1.08958654906766e-276);
    EXPECT_SAME(chiSquareP(1300, 27), 4.41865215016346e-257);
    EXPECT_SAME(studentP(40, 27), 1.42987513023214e-25);
    EXPECT_SAME(studentP(-30, 1000), 1.53746874440444e-141);
    EXPECT_SAME(studentP(1e4, 99), 4.86347670794814e-299);
    EXPECT_SAME(fisherFP(2.3, 6, 20), 0.0749862605609926);
    EXPECT_SAME(fisherFP(1000, 6, 20), 1.07461203470243e-23);
    EXPECT_SAME(normalP(-37), 1.14511424450486e-299);
    EXPECT_NEAR(probit(0.975), 1.95996398454005, 1e-13);
}

// Exact fractions: one outcome of 2^1000, and 1 + 1000 of them.
TEST(Tails, AreExactFractions) {
    EXPECT_SAME(binomialLower(0, 1000, 0.5), std::ldexp(1, -1000));
    EXPECT_SAME(binomialLower(1, 1000, 0.5), std::ldexp(1001, -1000));
    EXPECT_SAME(binomialUpper(500, 500, 0.25), std::ldexp(1, -1000));
    EXPECT_SAME(binomialMass(2, 4, 0.5), 6.0 / 16);
}

TEST(Tails, OfBinomialsReachBeyondTheOutcomes) {
    EXPECT_EQ(binomialLower(-1, 5, 0.5), 0);
    EXPECT_EQ(binomialLower(5, 5, 0.5), 1);
    EXPECT_EQ(binomialUpper(0, 5, 0.5), 1);
    EXPECT_EQ(binomialUpper(6, 5, 0.5), 0);
    EXPECT_EQ(binomialLower(3, 5, 0), 1); // nobody, for certain
    EXPECT_EQ(binomialUpper(1, 5, 0), 0);
    EXPECT_EQ(binomialLower(3, 5, 1), 0);
    EXPECT_EQ(binomialUpper(5, 5, 1), 1);
}

TEST(Tails, MeetInTheMiddle) {
    for (int n = 1; n < 40; ++n)
        for (int k = 0; k <= n; ++k)
            EXPECT_NEAR(binomialLower(k - 1, n, 0.3) + binomialUpper(k, n, 0.3), 1, 1e-14);
    EXPECT_EQ(chiSquareP(0, 3), 1);
    EXPECT_EQ(normalP(0), 1);
    EXPECT_NEAR(studentP(0, 3), 1, 1e-15);
}

} // namespace
} // namespace obscura
