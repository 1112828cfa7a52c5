#include "base/error.h"

#include "inference/equivalence.h"
#include <gtest/gtest.h>

#include <algorithm>

namespace obscura {
namespace {

// Of the thesis' conditions: R 4.2.2, max(pbinom(k - 1, n, .5 - d, lower = FALSE),
// pbinom(k, n, .5 + d)).
TEST(Equivalence, OfTheThesisIsThatOfR) {
    EXPECT_NEAR(equivalenceP({18, 18}, 0.10), 0.145980968776, 1e-11);
    EXPECT_NEAR(equivalenceP({18, 18}, 0.15), 0.0457201397817, 1e-12);
    EXPECT_NEAR(equivalenceP({18, 18}, 0.20), 0.00928120533661611, 1e-15);
    EXPECT_NEAR(equivalenceP({18, 18}, 0.25), 0.00106795589785, 1e-13);
    EXPECT_NEAR(equivalenceP({16, 20}, 0.20), 0.047038240453, 1e-12);
    EXPECT_NEAR(equivalenceP({21, 15}, 0.10), 0.481891702627, 1e-11);
    EXPECT_NEAR(equivalenceP({15, 21}, 0.10), 0.481891702627, 1e-11);
    EXPECT_NEAR(equivalenceP({11, 25}, 0.25), 0.274862649566, 1e-11);
}

// R: max(abs(qbeta limits at 90 % - .5)).
TEST(Equivalence, SmallestMarginOfTheThesisIsThatOfR) {
    EXPECT_NEAR(smallestMargin({18, 18}), 0.1467, 5e-5);
    EXPECT_NEAR(smallestMargin({14, 22}), 0.2473, 5e-5);
    EXPECT_NEAR(smallestMargin({11, 25}), 0.318246229298065, 1e-13);
    EXPECT_NEAR(smallestMargin({21, 15}), 0.2228, 5e-5);
}

TEST(Equivalence, IsGrantedFromTheSmallestMarginOn) {
    for (const double level : {0.05, 0.01})
        for (int a = 1; a <= 30; ++a)
            for (int b = 1; b <= 30; ++b)
                EXPECT_NEAR(equivalenceP({a, b}, smallestMargin({a, b}, level)), level, 1e-9)
                    << a << ' ' << b;
}

// Whatever the true share outside of the margin, it is granted in at most 5 % of studies.
TEST(Equivalence, IsNotGrantedTooOften) {
    for (const int n : {20, 36, 100})
        for (const double margin : {0.1, 0.2}) {
            double granted = 0, mass = 1;
            for (int i = 0; i < n; ++i)
                mass *= 0.5 + margin; // Bin(n, 1/2 - margin) at 0
            for (int k = 0; k <= n; ++k) {
                if (equivalenceP({n - k, k}, margin) < 0.05)
                    granted += mass;
                mass *= (n - k) / (k + 1.0) * (0.5 - margin) / (0.5 + margin);
            }
            EXPECT_LE(granted, 0.05) << n << ' ' << margin;
        }
}

TEST(Equivalence, OfFewOrUnanimousOrVeryManyVotes) {
    EXPECT_EQ(equivalenceP({1, 0}, 0.4), 1);
    EXPECT_EQ(equivalenceP({0, 36}, 0.5), 1);
    EXPECT_EQ(equivalenceP({1, 35}, 0.5), 0); // all shares but 0 and 1 are within
    EXPECT_NEAR(equivalenceP({1, 1}, 0), 0.75, 1e-15);
    EXPECT_EQ(smallestMargin({5, 0}), 0.5);
    EXPECT_NEAR(equivalenceP({1'000'000'000, 1'000'000'000}, 1e-6), 0.464378, 1e-4);
    EXPECT_LT(smallestMargin({1'000'000'000, 1'000'000'000}), 2e-5);
    EXPECT_THROW(smallestMargin({0, 0}), Error);
    EXPECT_THROW(equivalenceP({0, 0}, 0.1), Error);
}

} // namespace
} // namespace obscura
