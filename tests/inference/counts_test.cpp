#include "base/csv.h"
#include "base/error.h"
#include "base/files.h"

#include "inference/counts.h"
#include "inference/tails.h"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

namespace obscura {
namespace {

// The seven conditions of the thesis (Table 4). R 4.2.2 computed the figures: chisq.test,
// binom.test, prop.test's score interval, qnorm; the shared golden/ has its script and 300 values.
struct Golden {
    int condition;
    Votes votes;
    double chiSquare, chiSquareP, exactP, low, high, g, h, w, jod;
};
void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.condition; }

const Golden goldens[] = {
    {1, {18, 18}, 0, 1, 1, 0.344743254096, 0.655256745904, 0, 0, 0, 0},
    {2,
     {14, 22},
     1.77777777778,
     0.182422439452,
     0.242984954035,
     0.448644590966,
     0.752151269346,
     0.111111111111,
     0.224093092301,
     0.222222222222,
     0.418414285733},
    {3,
     {11, 25},
     5.44444444444,
     0.0196306572573,
     0.0288167196559,
     0.531437271495,
     0.819955484052,
     0.194444444444,
     0.399425239881,
     0.388888888889,
     0.753885524519},
    {4,
     {16, 20},
     0.444444444444,
     0.504985075094,
     0.61771931703,
     0.395810617557,
     0.704587312599,
     0.0555555555556,
     0.111341014341,
     0.111111111111,
     0.20713479907},
    {5,
     {11, 25},
     5.44444444444,
     0.0196306572573,
     0.0288167196559,
     0.531437271495,
     0.819955484052,
     0.194444444444,
     0.399425239881,
     0.388888888889,
     0.753885524519},
    {6, {18, 18}, 0, 1, 1, 0.344743254096, 0.655256745904, 0, 0, 0, 0},
    {7,
     {21, 15},
     1,
     0.317310507863,
     0.405032246141,
     0.271405620514,
     0.577997484251,
     -0.0833333333333,
     -0.16744807922,
     0.166666666667,
     -0.311981604149},
};

class Thesis : public testing::TestWithParam<Golden> {};

TEST_P(Thesis, AgreesWithR) {
    const Golden& golden = GetParam();
    const Votes votes = golden.votes;
    const Interval share = wilson(votes.b, votes.total());
    EXPECT_NEAR(chiSquare(votes), golden.chiSquare, 1e-9);
    EXPECT_NEAR(chiSquareP(chiSquare(votes)), golden.chiSquareP, 1e-9);
    EXPECT_NEAR(exactP(votes), golden.exactP, 1e-9);
    EXPECT_NEAR(share.low, golden.low, 1e-9);
    EXPECT_NEAR(share.high, golden.high, 1e-9);
    EXPECT_NEAR(cohenG(votes), golden.g, 1e-9);
    EXPECT_NEAR(cohenH(votes), golden.h, 1e-9);
    EXPECT_NEAR(cohenW(votes), golden.w, 1e-9);
    ASSERT_TRUE(jod(votes));
    EXPECT_NEAR(*jod(votes), golden.jod, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Counts, Thesis, testing::ValuesIn(goldens), [](const auto& golden) {
    return fmt::format("condition{}", golden.param.condition);
});

TEST(Counts, HaveNoFiniteJodWhenVotesAreUnanimous) {
    EXPECT_FALSE(jod({0, 5}));
    EXPECT_FALSE(jod({5, 0}));
    EXPECT_NEAR(exactP({0, 5}), 2.0 / 32, 1e-15);
}

TEST(Counts, GiveFiniteValuesInRangeForAllSmallCounts) {
    for (int a = 0; a <= 40; ++a)
        for (int b = a == 0 ? 1 : 0; b <= 40; ++b) {
            const Votes v{a, b};
            const Interval score = wilson(b, v.total());
            const double share = static_cast<double>(b) / (a + b), p = chiSquareP(chiSquare(v));
            EXPECT_TRUE(p >= 0 && p <= 1) << a << ' ' << b;
            EXPECT_TRUE(exactP(v) > 0 && exactP(v) <= 1) << a << ' ' << b;
            EXPECT_TRUE(0 <= score.low && score.low <= share) << a << ' ' << b;
            EXPECT_TRUE(share <= score.high && score.high <= 1) << a << ' ' << b;
            EXPECT_TRUE(std::isfinite(cohenG(v)) && std::isfinite(cohenH(v)) &&
                        std::isfinite(cohenW(v)));
            EXPECT_TRUE(!jod(v) || std::isfinite(*jod(v)));
        }
}

TEST(Counts, TurnOverWithTheVotes) {
    const Votes votes{11, 25}, turned{25, 11};
    EXPECT_DOUBLE_EQ(exactP(votes), exactP(turned));
    EXPECT_DOUBLE_EQ(chiSquare(votes), chiSquare(turned));
    EXPECT_NEAR(wilson(25, 36).low, 1 - wilson(11, 36).high, 1e-15);
    EXPECT_NEAR(*jod(votes), -*jod(turned), 1e-14);
}

double probabilityOfVotes(int b, int n, double share) {
    return std::exp(std::lgamma(n + 1) - std::lgamma(b + 1) - std::lgamma(n - b + 1) +
                    b * std::log(share) + (n - b) * std::log(1 - share));
}

// How often a test at .05 rejects although everybody guesses.
template <typename P>
double size(int n, P p) {
    double total = 0;
    for (int b = 0; b <= n; ++b)
        if (p(Votes{n - b, b}) < 0.05)
            total += probabilityOfVotes(b, n, 0.5);
    return total;
}

TEST(Counts, TestsHaveTheirKnownSizesAtN36) {
    EXPECT_NEAR(size(36, exactP), 0.0288, 5e-5);
    EXPECT_NEAR(size(36, [](Votes votes) { return chiSquareP(chiSquare(votes)); }), 0.0652, 5e-5);
}

TEST(Counts, ExactTestNeverRejectsTooOften) {
    for (int n = 1; n <= 120; ++n)
        EXPECT_LE(size(n, exactP), 0.05) << n;
}

// Wilson's limits are the shares p at which the score statistic equals the normal quantile.
TEST(Wilson, LimitsSolveTheScoreEquation) {
    constexpr double z = 1.959963984540054; // 97.5 % of the standard normal distribution
    for (int n = 1; n <= 60; ++n)
        for (int k = 0; k <= n; ++k) {
            const double share = static_cast<double>(k) / n;
            const auto [low, high] = wilson(k, n);
            for (const double p : {low, high})
                EXPECT_NEAR(std::pow(share - p, 2), z * z * p * (1 - p) / n, 1e-14)
                    << k << '/' << n;
        }
}

TEST(Wilson, ReachesExactlyTheEdges) {
    EXPECT_EQ(wilson(0, 36).low, 0);
    EXPECT_NEAR(wilson(0, 36).high, 0.096419, 5e-7);
    EXPECT_NEAR(wilson(36, 36).low, 0.903581, 5e-7);
    EXPECT_EQ(wilson(36, 36).high, 1);
}

TEST(Wilson, CoversTheTrueShareAboutAsOftenAsItSays) {
    constexpr int n = 36, steps = 999;
    double mean = 0;
    for (int step = 1; step <= steps; ++step) {
        const double share = step / (steps + 1.0);
        for (int k = 0; k <= n; ++k)
            if (const auto [low, high] = wilson(k, n); low <= share && share <= high)
                mean += probabilityOfVotes(k, n, share) / steps;
    }
    EXPECT_NEAR(mean, 0.95, 0.005);
}

TEST(Counts, CountsBeyond32BitsAreRight) {
    const Votes votes{2'000'000'000, 2'000'000'000};
    EXPECT_EQ(votes.total(), 4'000'000'000);
    EXPECT_EQ(chiSquare(votes), 0);
    EXPECT_NEAR(exactP(votes), 1, 1e-9);
    const Interval share = wilson(votes.b, votes.total());
    EXPECT_GT(share.low, 0.4999);
    EXPECT_LT(share.high, 0.5001);
}

// R 4.2.2 throughout: golden/golden_statistics.R, or the call that is given.
TEST(Counts, CorrectedAndMidPOfTheThesisAreThoseOfR) {
    EXPECT_NEAR(chiSquareYates({11, 25}), 4.69444444444, 1e-11);
    EXPECT_NEAR(chiSquareYates({21, 15}), 0.694444444444, 1e-12);
    EXPECT_EQ(chiSquareYates({18, 18}), 0);
    EXPECT_NEAR(midP({14, 22}), 0.187741558999, 1e-12);
    EXPECT_NEAR(midP({25, 11}), 0.0200738519197, 1e-13);
    EXPECT_EQ(midP({18, 18}), 1);
    EXPECT_EQ(midP({0, 1}), 0.5);
}

void expectInterval(Interval found, double low, double high) {
    EXPECT_NEAR(found.low, low, 1e-13);
    EXPECT_NEAR(found.high, high, 1e-13);
}

// qbeta(a / 2, k, n - k + 1), qbeta(1 - a / 2, k + 1, n - k); prop.test(correct = FALSE).
TEST(Counts, IntervalsAreThoseOfR) {
    expectInterval(clopperPearson(25, 36), 0.5189293699999201, 0.8365260153715064);
    expectInterval(clopperPearson(0, 36), 0, 0.097393755914492);
    expectInterval(clopperPearson(1, 1), 0.025, 1);
    expectInterval(clopperPearson(25, 36, 0.9), 0.545316268686756, 0.818246229298065);
    expectInterval(clopperPearson(100'000'000, 1'000'000'000), 0.0999814068067956,
                   0.100018595508732);
    expectInterval(jeffreys(0, 36), 1.35453669888258e-05, 0.0669444823423745);
    expectInterval(jeffreys(25, 36, 0.99), 0.481816063431106, 0.85916989893317);
    expectInterval(wilson(25, 36, 0.9), 0.558308552290136, 0.803396742368855);
}

// The interval belongs to the test: it excludes 1/2 if and only if the test rejects.
TEST(Counts, IntervalsAgreeWithTheirTests) {
    for (int n = 1; n <= 80; ++n)
        for (int k = 0; k <= n; ++k) {
            const auto excludes = [](Interval i) { return i.low > 0.5 || i.high < 0.5; };
            EXPECT_EQ(excludes(clopperPearson(k, n)), exactP({n - k, k}) < 0.05) << k << '/' << n;
            EXPECT_EQ(excludes(wilson(k, n)), chiSquareP(chiSquare({n - k, k})) < 0.05);
        }
}

TEST(Counts, UnanimousVotesBoundTheJodFromOneSide) {
    const JodLimits all = jodLimits(clopperPearson(36, 36)), none = jodLimits(wilson(0, 36)),
                    some = jodLimits(wilson(25, 36));
    EXPECT_NEAR(all.low.value(), 1.922261678757708, 1e-12); // qnorm(.025^(1/36)) / qnorm(.75)
    EXPECT_FALSE(all.high);
    EXPECT_FALSE(none.low);
    EXPECT_LT(none.high.value(), -1.9);
    EXPECT_NEAR(some.low.value(), 0.117, 5e-4);
    EXPECT_NEAR(some.high.value(), 1.357, 5e-4);
}

TEST(Counts, BayesianFiguresAreThoseOfR) {
    EXPECT_NEAR(std::exp(logBayesFactor({18, 18})), 0.204656249591, 1e-11);
    EXPECT_NEAR(std::exp(logBayesFactor({11, 25})), 3.09132287513, 1e-10);
    EXPECT_NEAR(std::exp(logBayesFactor({11, 25}, 10)), 3.59134319561, 1e-10);
    EXPECT_NEAR(logBayesFactor({11, 25}, 0.5), 0.770042192452618, 1e-12);
    EXPECT_NEAR(logBayesFactor({1100, 0}), 755.457924479217, 1e-10);
    EXPECT_NEAR(logBayesFactor({0, 1}), 0, 1e-15); // one vote says nothing
    EXPECT_NEAR(ropeProbability({11, 25}, 0.1), 0.133160152718, 1e-11);
    EXPECT_NEAR(ropeProbability({11, 25}, 0.15, 0.5), 0.29258500253968, 1e-12);
    EXPECT_NEAR(ropeProbability({10, 990}, 0.1) / 3.9818767326045e-201, 1, 1e-10);
    EXPECT_NEAR(ropeProbability({990, 10}, 0.1) / 3.9818767326045e-201, 1, 1e-10);
    EXPECT_EQ(ropeProbability({11, 25}, 0), 0);
    EXPECT_EQ(ropeProbability({11, 25}, 0.5), 1);
    EXPECT_NEAR(probabilityOfMajority({11, 25}), 0.989963074040134, 1e-13);
    EXPECT_NEAR(probabilityOfMajority({999, 1}) / 4.67565072870157e-299, 1, 1e-10);
    EXPECT_NEAR(probabilityOfMajority({0, 0}), 0.5, 1e-15); // the prior
}

// 1 / (N + 1) for a uniform prior is the probability of every count: the factor from it.
TEST(Counts, BayesFactorOfVeryManyVotesIsThatOfStirling) {
    const double n = 2e9;
    EXPECT_NEAR(logBayesFactor({1'000'000'000, 1'000'000'000}),
                0.5 * std::log(3.14159265358979 * n / 2) - std::log(n + 1), 1e-7);
}

TEST(Counts, WithoutVotesThrow) {
    for (const Votes votes : {Votes{0, 0}, Votes{-1, 3}}) {
        for (const auto function :
             {chiSquare, chiSquareYates, exactP, midP, cohenG, cohenH, cohenW})
            EXPECT_THROW(function(votes), Error);
        for (const auto function : {wilson, clopperPearson, jeffreys})
            EXPECT_THROW(function(votes.b, votes.total(), 0.95), Error);
    }
}

// By R: the definition with qnorm, and uniroot for p.
TEST(BalancedShare, IsTheMeanOfBothOrders) {
    const auto share = balancedShare({7, 3}, {5, 15});
    ASSERT_TRUE(share);
    EXPECT_DOUBLE_EQ(share->share, 0.525);
    EXPECT_NEAR(share->interval.low, 0.379419892536, 1e-11);
    EXPECT_NEAR(share->interval.high, 0.691602582059, 1e-11);
    EXPECT_NEAR(share->p, 0.770133942812, 1e-9);
    const auto extreme = balancedShare({1, 9}, {0, 20});
    EXPECT_NEAR(extreme->interval.low, 0.777903693127, 1e-11);
    EXPECT_NEAR(extreme->interval.high, 0.991061893452, 1e-11);
    EXPECT_NEAR(extreme->p, 1.250376633e-07, 1e-15);
    EXPECT_DOUBLE_EQ(balancedShare({20, 0}, {0, 10})->p, 1);
    EXPECT_FALSE(balancedShare({20, 3}, {}));
}

} // namespace
} // namespace obscura
