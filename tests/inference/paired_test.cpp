#include "base/error.h"
#include "tests/inference/trials.h"

#include "inference/paired.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

void expectTest(const std::optional<Test>& found, double statistic, double df, double p,
                double within = 1e-12) {
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->statistic.value(), statistic, within * std::max(1.0, statistic));
    EXPECT_EQ(found->df, df);
    EXPECT_NEAR(found->p, p, within);
}

PairedVotes changesOf(std::size_t first, std::size_t second) {
    PairedVotes votes;
    for (const std::vector<int>& person : trialAnswers({first, second}))
        ++(person[0]   ? person[1] ? votes.both : votes.firstOnly
           : person[1] ? votes.secondOnly
                       : votes.neither);
    return votes;
}

// The golden values of the trials; R 4.2.2 computed all eight.
TEST(McNemarTest, OfTheTrialsIsThatOfR) {
    const McNemar low = mcnemar(changesOf(3, 6)), high = mcnemar(changesOf(2, 5));
    EXPECT_EQ(low.firstOnly, 11);
    EXPECT_EQ(low.secondOnly, 3);
    expectTest(low.uncorrected, 4.57142857143, 1, 0.0325094446457, 1e-11);
    expectTest(low.corrected, 3.5, 1, 0.0613688291394);
    EXPECT_NEAR(low.exactP, 0.057373046875, 1e-14);
    EXPECT_NEAR(low.midP, 0.03515625, 1e-14);
    EXPECT_EQ(high.firstOnly, 4);
    EXPECT_EQ(high.secondOnly, 11);
    expectTest(high.corrected, 2.4, 1, 0.121335250358);
    EXPECT_NEAR(high.exactP, 0.118469238281, 1e-12);
    // mcnemar.test(matrix(c(5, 9, 2, 4), 2))
    expectTest(mcnemar({5, 9, 2, 4}).corrected, 3.27272727272727, 1, 0.0704404292720882);
}

TEST(McNemarTest, WithoutChangesOrWithAsManyBothWays) {
    const McNemar none = mcnemar({7, 0, 0, 3}), even = mcnemar({0, 4, 4, 0});
    EXPECT_FALSE(none.uncorrected.statistic || none.corrected.statistic);
    EXPECT_TRUE(none.uncorrected.p == 1 && none.corrected.p == 1 && none.exactP == 1 &&
                none.midP == 1);
    EXPECT_EQ(even.uncorrected.statistic, 0);
    EXPECT_EQ(even.corrected.statistic, 1 / 8.0); // to the letter
    EXPECT_TRUE(even.exactP == 1 && even.midP == 1);
    const std::int64_t many = 1'000'000'000;
    EXPECT_NEAR(mcnemar({0, many, many + 100'000, 0}).uncorrected.statistic.value(), 4.99975, 1e-5);
}

Interval boundsOfAllPairings(int n, int first, int second) {
    Interval bounds{1, 0};
    for (int both = std::max(0, first + second - n); both <= std::min(first, second); ++both) {
        const double p = mcnemar({both, first - both, second - both, 0}).exactP;
        bounds = {std::min(bounds.low, p), std::max(bounds.high, p)};
    }
    return bounds;
}

TEST(McNemarTest, BoundsAreThoseOfAllPairings) {
    for (const int n : {1, 2, 7, 30})
        for (int first = 0; first <= n; ++first)
            for (int second = 0; second <= n; ++second) {
                const auto [low, high] = mcnemarBounds(n, first, second);
                const Interval expected = boundsOfAllPairings(n, first, second);
                EXPECT_TRUE(low == expected.low && high == expected.high)
                    << n << ' ' << first << ' ' << second;
            }
}

// Golden output B2: conditions 3 and 6 of the thesis.
TEST(McNemarTest, BoundsOfTheThesisAreThoseOfR) {
    EXPECT_NEAR(mcnemarBounds(36, 25, 18).low, 0.015625, 1e-15);
    EXPECT_NEAR(mcnemarBounds(36, 25, 18).high, 0.264930896461, 1e-11);
    EXPECT_THROW(mcnemarBounds(36, 37, 1), Error);
    EXPECT_THROW(mcnemarBounds(36, 1, -1), Error);
}

TEST(CochranQ, OfTheTrialsIsThatOfR) {
    EXPECT_EQ(columnTotals(trialAnswers()), (std::vector<double>{17, 16, 20, 14, 23, 12, 14}));
    expectTest(cochranQ(trialAnswers()), 13.347826087, 6, 0.0378331962654, 1e-10);
    expectTest(cochranQ(trialAnswers({1, 3, 6})), 6.125, 2, 0.046770622384);
}

// Ties, unanimous people, 12 x 4; R: friedman.test(X), and survival::clogit(y ~ x + strata(id))
// whose score test is `sctest`.
const AnswerTable sample = {{1, 0, 1, 1}, {0, 0, 1, 1}, {1, 1, 1, 1}, {0, 0, 0, 0},
                            {0, 1, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 1, 1},
                            {0, 1, 1, 1}, {1, 0, 1, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}};

TEST(CochranQ, IsFriedmansTestOfZerosAndOnes) {
    expectTest(cochranQ(sample), 7.8, 3, 0.0503310978598534);
}

TEST(PairedTrend, IsTheScoreTestOfConditionalLogisticRegression) {
    expectTest(pairedTrend(sample, std::vector<double>{0, 1, 2, 3}), 6.18857142857143, 1,
               0.0128577940823717);
    expectTest(pairedTrend(sample, std::vector<double>{-1, 0, 2, 10}), 6.19464882943144, 1,
               0.0128137147177944);
}

TEST(PairedTrend, AndCochranQAreMcNemarsOfTwoConditions) {
    const obscura::Test expected = mcnemar(changesOf(3, 6)).uncorrected;
    for (const auto& found : {cochranQ(trialAnswers({3, 6})),
                              pairedTrend(trialAnswers({3, 6}), std::vector<double>{5, 2})})
        expectTest(found, *expected.statistic, 1, expected.p);
}

TEST(PairedTrend, AndCochranQAreAbsentWhereNothingVaries) {
    const std::vector<double> scores = {1, 2, 3};
    for (const AnswerTable& table : {AnswerTable{}, AnswerTable{{1, 1, 1}, {0, 0, 0}}})
        EXPECT_FALSE(cochranQ(table));
    EXPECT_FALSE(pairedTrend({{1, 1, 1}, {0, 0, 0}}, scores));
    EXPECT_FALSE(pairedTrend({}, {}));
    EXPECT_FALSE(pairedTrend({{1, 0, 1}}, std::vector{0.1, 0.1, 0.1})); // whose mean rounds
    EXPECT_FALSE(cochranQ({{1}, {0}}));
}

TEST(PairedTrend, AndCochranQRefuseIncompletePeople) {
    EXPECT_THROW(cochranQ({{1, 0}, {}}), Error);
    EXPECT_THROW(cochranQ({{1, 0}, {1, 2}}), Error);
    EXPECT_THROW(pairedTrend(sample, std::vector<double>{1, 2}), Error);
    EXPECT_THROW(pairedTrend(sample, std::vector<double>{1, 2, 3, std::nan("")}), Error);
}

const std::vector<Votes> conditions = {{18, 18}, {11, 25}, {16, 20}, {7, 1}};

// R: chisq.test(cbind(a, b), correct = FALSE); prop.trend.test(b, a + b, c(0, 1, 2, 5)).
TEST(Totals, AreComparedAsInR) {
    expectTest(homogeneity(conditions), 9.2464610042735, 3, 0.0261873311670721);
    expectTest(homogeneity(std::vector<Votes>{{18, 18}, {11, 25}, {18, 18}}), 3.691664, 2, 0.157894,
               5e-7);
    const std::vector<double> scores = {0, 1, 2, 5};
    expectTest(trend(conditions, scores), 2.87306096681097, 1, 0.0900734081352057);
}

TEST(Totals, LeaveOutConditionsWithoutVotes) {
    std::vector<Votes> more = conditions;
    more.push_back({0, 0});
    expectTest(homogeneity(more), 9.2464610042735, 3, 0.0261873311670721);
    expectTest(trend(more, std::vector<double>{0, 1, 2, 5, 1000}), 2.87306096681097, 1,
               0.0900734081352057);
}

TEST(Totals, AreNotComparedWhereNothingVaries) {
    for (const std::vector<Votes>& votes : {std::vector<Votes>{},
                                            {{0, 0}},
                                            {{3, 4}},
                                            {{3, 4}, {0, 0}},
                                            {{3, 0}, {9, 0}},
                                            {{0, 3}, {0, 9}}}) {
        EXPECT_FALSE(homogeneity(votes));
        EXPECT_FALSE(trend(votes, std::vector<double>(votes.size(), 1.0)));
    }
    const std::vector<Votes> varied = {{0, 0}, {3, 4}, {1, 9}, {5, 5}};
    EXPECT_FALSE(trend(varied, std::vector{7.0, 0.1, 0.1, 0.1}));
    EXPECT_TRUE(trend(varied, std::vector{7.0, 0.1, 0.2, 0.1}));
    const std::int64_t many = 1'000'000'000;
    EXPECT_TRUE(std::isfinite(homogeneity(std::vector<Votes>{{many, 1}, {1, many}})->p));
}

// Position and choice by condition; golden values of the trials.
TEST(MantelHaenszelTest, OfTheTrialsIsThatOfR) {
    const std::vector<FourfoldTable> strata = {
        {{7, 7}, {4, 10}},  {{6, 8}, {6, 8}},  {{3, 11}, {5, 9}}, {{5, 9}, {9, 5}},
        {{2, 12}, {3, 11}}, {{5, 9}, {11, 3}}, {{6, 8}, {8, 6}}};
    const auto found = mantelHaenszel(strata);
    ASSERT_TRUE(found);
    expectTest(found->test, 3.14054927302, 1, 0.0763680853409, 1e-11);
    EXPECT_NEAR(std::exp(found->logOddsRatio.value().value), 1.69135802469, 1e-11);
}

// mantelhaen.test(array(c(8,3,2,9, 5,5,6,4, 0,0,3,2, 7,2,3,3), c(2,2,4)), correct = FALSE); the
// standard error from its conf.int. A stratum of one vote, which R refuses, and an empty one say
// nothing.
TEST(MantelHaenszelTest, OfUnbalancedStrataIsThatOfR) {
    std::vector<FourfoldTable> strata = {
        {{2, 8}, {9, 3}}, {{6, 5}, {4, 5}}, {{3, 0}, {2, 0}}, {{3, 7}, {3, 2}}};
    for (int i = 0; i < 2; ++i) {
        const auto found = mantelHaenszel(strata);
        ASSERT_TRUE(found);
        expectTest(found->test, 3.41382922996333, 1, 0.0646522586859968);
        EXPECT_NEAR(std::exp(found->logOddsRatio.value().value), 2.61087866108787, 1e-12);
        EXPECT_NEAR(found->logOddsRatio->standardError, 0.535743931247349, 1e-12);
        strata.push_back({{0, 1}, {0, 0}});
        strata.push_back({});
    }
}

TEST(MantelHaenszelTest, HasNoOddsRatioWithoutExceptions) {
    const auto found = mantelHaenszel(std::vector<FourfoldTable>{{{0, 5}, {5, 0}}});
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->logOddsRatio);
    EXPECT_NEAR(found->test.statistic.value(), 9, 1e-12);
    EXPECT_FALSE(mantelHaenszel({}));
    EXPECT_FALSE(mantelHaenszel(std::vector<FourfoldTable>{{{0, 5}, {0, 5}}, {{3, 2}, {0, 0}}}));
}

// R: t.test(v, mu = .5); wilcox.test(v, mu = .5, exact = FALSE).
const std::vector<double> shares = {.5, .25, .75, .75, 1, .5, .625, .375, .875, .75, .5625};

TEST(Shares, AreTestedAsInR) {
    expectTest(tTest(shares, 0.5), 1.96216023306044, 10, 0.0781554732914583);
    const auto ranks = signedRankTest(shares, 0.5);
    ASSERT_TRUE(ranks);
    EXPECT_EQ(ranks->statistic, 37);
    EXPECT_FALSE(ranks->df);
    EXPECT_NEAR(ranks->p, 0.0939703204304259, 1e-13);
    EXPECT_NEAR(signedRankTest(std::vector{.75, .25, .75}, 0.5)->p, 0.772829992684448, 1e-13);
}

// Shares of second images of the 28 people; golden output C3.
TEST(Shares, OfSecondImagesInTheTrialsAreThoseOfR) {
    std::vector<double> second;
    for (const int chosen :
         {4, 5, 5, 4, 5, 3, 7, 3, 5, 6, 3, 2, 2, 3, 3, 4, 4, 4, 6, 4, 6, 4, 2, 2, 2, 4, 4, 4})
        second.push_back(chosen / 7.0);
    expectTest(tTest(second, 0.5), 1.668862, 27, 0.106702, 5e-7);
    EXPECT_EQ(signedRankTest(second, 0.5)->statistic, 241);
    EXPECT_NEAR(signedRankTest(second, 0.5)->p, 0.388352, 5e-7);
}

TEST(Shares, AreNotTestedWhereNothingVaries) {
    EXPECT_FALSE(tTest({}, 0.5));
    EXPECT_FALSE(tTest(std::vector{0.7}, 0.5));
    EXPECT_FALSE(tTest(std::vector{0.1, 0.1, 0.1}, 0.5));
    EXPECT_FALSE(signedRankTest({}, 0.5));
    EXPECT_FALSE(signedRankTest(std::vector{0.5, 0.5}, 0.5));
    EXPECT_NEAR(signedRankTest(std::vector{0.7}, 0.5)->p, 1, 1e-15);
    EXPECT_THROW(tTest(std::vector{0.1, std::nan("")}, 0.5), Error);
    EXPECT_THROW(signedRankTest(std::vector{HUGE_VAL}, 0.5), Error);
}

// Nobody changed an answer over three levels: slopes of exactly 0, without a t, and p = 1.
// Found by obscura-validity, where Boost refused a t of 0 / 0.
TEST(People, WhoAllStandExactlyAtTheCentreHaveNoT) {
    const std::vector<double> zeros(28, 0.0);
    EXPECT_FALSE(tTest(zeros, 0));
    EXPECT_FALSE(tInterval(zeros));
    EXPECT_EQ(centreTest(zeros, 0).p, 1);
}

} // namespace
} // namespace obscura
