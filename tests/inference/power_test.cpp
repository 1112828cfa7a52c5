#include "inference/equivalence.h"
#include "inference/power.h"
#include "inference/tails.h"
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

double chiSquareTestP(Votes votes) { return chiSquareP(chiSquare(votes)); }

// R 4.2.2: sums of dbinom over what binom.test rejects.
TEST(Power, OfTheExactTestIsThatOfR) {
    const double expected[] = {0.162342538518, 0.356336115242, 0.609077145471, 0.832934068277,
                               0.957572276888};
    for (int i = 0; i < 5; ++i)
        EXPECT_NEAR(power(exactP, 36, 0.6 + 0.05 * i), expected[i], 1e-11);
    EXPECT_NEAR(power(exactP, 36, 0.4), expected[0], 1e-11);
    EXPECT_NEAR(power(exactP, 100, 0.62, 0.01), 0.381599297581029, 1e-13);
}

// R: sum(dbinom(x[pchisq((2 * x - 100)^2 / 100, 1, lower = FALSE) <= .05], 100, .62)).
TEST(Power, OfChiSquareIsThatOfR) {
    EXPECT_NEAR(power(chiSquareTestP, 100, 0.62), 0.698759246143181, 1e-13);
}

TEST(Power, AtAnEvenShareIsTheKnownSize) {
    EXPECT_NEAR(power(exactP, 36, 0.5), 0.0288167196559, 1e-12);
    EXPECT_NEAR(power(chiSquareTestP, 36, 0.5), 0.065245, 5e-7);
    EXPECT_EQ(power(exactP, 1, 0.5), 0);
    EXPECT_NEAR(power(exactP, 6, 1), 1, 1e-15); // 2 / 64 is the first below .05
    EXPECT_EQ(power(exactP, 5, 1), 0);
}

TEST(Power, OfEquivalenceIsThatOfR) {
    EXPECT_EQ(equivalencePower(36, 0.10), 0);
    EXPECT_NEAR(equivalencePower(36, 0.15), 0.1321, 5e-5);
    EXPECT_NEAR(equivalencePower(100, 0.15, 0.53), 0.729450546907809, 1e-13);
}

// R: the first of 10 ... 460 from which on none is below.
TEST(SampleSize, OfTheExactTestIsThatOfR) {
    const int eighty[] = {210, 97, 54, 35, 23}, ninety[] = {274, 121, 70, 42, 30},
              ofSeven[] = {324, 146, 82, 53, 35};
    for (int i = 0; i < 5; ++i) {
        const double share = 0.6 + 0.05 * i;
        EXPECT_EQ(sampleSize(exactP, share), eighty[i]);
        EXPECT_EQ(sampleSize(exactP, 1 - share), eighty[i]);
        EXPECT_EQ(sampleSize(exactP, share, 0.9), ninety[i]);
        EXPECT_EQ(sampleSize(exactP, share, 0.8, 0.05 / 7), ofSeven[i]);
    }
}

TEST(SampleSize, OfEquivalenceIsThatOfR) {
    const int eighty[] = {227, 100, 57, 35}, ninety[] = {281, 126, 69, 44};
    const double margins[] = {0.1, 0.15, 0.2, 0.25};
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(equivalenceSampleSize(margins[i]), eighty[i]);
        EXPECT_EQ(equivalenceSampleSize(margins[i], 0.5, 0.9), ninety[i]);
    }
}

// Against going through all n.
template <typename F>
int lastingSize(const F& powerOf, double target) {
    int size = 1;
    for (int n = 1; n <= 800; ++n)
        if (powerOf(n) < target)
            size = n + 1;
    return size;
}

TEST(SampleSize, IsTheOneBehindTheLastTooth) {
    for (const PofVotes test : {exactP, midP, chiSquareTestP})
        for (const double share : {0.6, 0.3, 0.66, 0.9, 0.99, 1.0})
            for (const double target : {0.5, 0.8, 0.99})
                for (const double level : {0.05, 0.001})
                    EXPECT_EQ(
                        sampleSize(test, share, target, level),
                        lastingSize([&](int n) { return power(test, n, share, level); }, target))
                        << share << ' ' << target << ' ' << level;
}

TEST(SampleSize, OfEquivalenceIsTheOneBehindTheLastTooth) {
    for (const double margin : {0.12, 0.2, 0.5})
        for (const double share : {0.5, 0.47, 0.55})
            for (const double target : {0.5, 0.8, 0.99})
                EXPECT_EQ(
                    equivalenceSampleSize(margin, share, target),
                    lastingSize([&](int n) { return equivalencePower(n, margin, share); }, target))
                    << margin << ' ' << share << ' ' << target;
}

TEST(SampleSize, IsAbsentWhereNoNumberIsEnough) {
    EXPECT_FALSE(sampleSize(exactP, 0.5));
    EXPECT_FALSE(sampleSize(exactP, 0.5001)); // some 200 million
    EXPECT_FALSE(equivalenceSampleSize(0));
    EXPECT_FALSE(equivalenceSampleSize(0.1, 0.6));
    EXPECT_FALSE(equivalenceSampleSize(0.0001));
    EXPECT_FALSE(approximateSampleSize(0.5));
    EXPECT_EQ(sampleSize(exactP, 0.505), 78'828);
    EXPECT_TRUE(sampleSize(exactP, 0.5015)); // between half a million and 2^20
}

TEST(SampleSize, ByTheNormalApproximationIsThatOfR) {
    const double expected[] = {193.847, 84.813, 46.626, 28.919, 19.261};
    for (int i = 0; i < 5; ++i)
        EXPECT_NEAR(approximateSampleSize(0.6 + 0.05 * i).value(), expected[i], 5e-4);
}

} // namespace
} // namespace obscura
