#include "base/error.h"
#include "tests/inference/matrices.h"

#include "inference/boosted.h"
#include "inference/link.h"
#include "inference/mlds.h"

#include <algorithm>

namespace obscura {
namespace {

// Six rounds of the ten triads of five levels, answers drawn in R (set.seed(5)).
std::vector<Quadruple> triads() {
    const int answers[] = {0, 1, 1, 0, 1, 0, 0, 1, 0, 1, 1, 1, 1, 0, 0, 0, 0, 0, 1, 1,
                           1, 1, 1, 0, 1, 0, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 1,
                           1, 1, 1, 1, 1, 1, 0, 1, 0, 1, 1, 1, 1, 0, 1, 0, 1, 1, 0, 1};
    std::vector<Quadruple> result;
    while (result.size() < std::size(answers))
        for (int a = 0; a < 5; ++a)
            for (int b = a + 1; b < 5; ++b)
                for (int c = b + 1; c < 5; ++c)
                    result.push_back({a, b, b, c, answers[result.size()] == 1});
    return result;
}

TEST(Mlds, AgreesWithR) {
    // glm(y ~ 0 + D[, -1], binomial("probit")), D as MLDS::make.ix.mat makes it; delta method
    const auto scale = differenceScale(5, triads());
    ASSERT_TRUE(scale);
    expectNear(scale->values,
               {0, -0.0995563555556, 1.2256520836472, 1.8687383715377, 3.3137572182285}, 1e-8);
    expectNear(scale->covariance.diagonal().cwiseSqrt(),
               {0, 0.342004795165, 0.474964680093, 0.651034489700, 1.016128569596}, 1e-7);
    EXPECT_NEAR(scale->logLikelihood, -25.8338574868, 1e-9);
    expectNear(scale->standard, {0, -0.0300433462681, 0.3698677974672, 0.5639333990004, 1}, 1e-9);
    expectNear(scale->standardErrors, {0, 0.1084947443481, 0.0582385517458, 0.0549627294733, 0},
               1e-8);
    EXPECT_NEAR(scale->sigma, 1 / 3.3137572182285, 1e-9);
}

TEST(Mlds, TheOrderWithinAndOfPairsDoesNotMatter) {
    auto turned = triads();
    for (std::size_t i = 0; i < turned.size(); ++i) {
        Quadruple& q = turned[i];
        if (i % 2 == 0)
            std::swap(q.a, q.b);
        if (i % 3 == 0)
            q = {q.c, q.d, q.a, q.b, !q.isSecondLarger};
    }
    EXPECT_TRUE(
        differenceScale(5, turned)->values.isApprox(differenceScale(5, triads())->values, 1e-9));
}

TEST(Mlds, AnswersWithoutNoiseHaveNoFiniteScale) {
    auto certain = triads();
    const double psi[] = {0, 1, 4, 9, 16};
    for (Quadruple& q : certain)
        q.isSecondLarger = psi[q.d] - psi[q.c] > psi[q.b] - psi[q.a];
    EXPECT_FALSE(differenceScale(5, certain));
}

TEST(Mlds, RefusesLevelsThatDoNotExistOrWereNotShown) {
    EXPECT_THROW(differenceScale(5, std::vector<Quadruple>{{0, 1, 1, 5, true}}), Error);
    EXPECT_THROW(differenceScale(5, std::vector<Quadruple>{{0, 0, 1, 2, true}}), Error);
    EXPECT_THROW(differenceScale(2, std::vector<Quadruple>{{0, 1, 0, 1, true}}), Error);
    EXPECT_THROW(differenceScale(6, triads()), Error) << "level 5 was never shown";
}

const Wins boosted =
    square({0, 4, 1, 0, 0, 8, 0, 4, 2, 0, 11, 8, 0, 5, 1, 12, 10, 7, 0, 4, 12, 12, 11, 8, 0});
const Wins plain =
    square({0, 9, 7, 3, 1, 11, 0, 9, 6, 3, 13, 11, 0, 8, 5, 17, 14, 12, 0, 9, 19, 17, 15, 11, 0});

TEST(Boosted, IsTheMaximumOfBothLikelihoods) {
    // R 4.2.2, optim(BFGS, ndeps 1e-5) and optimHess of the formula in boosted.h
    const auto found = boostedScale(boosted, plain, 0);
    ASSERT_TRUE(found);
    expectNear(found->boosted, {0, 0.9793782, 1.8618414, 2.7347713, 3.6471867}, 2e-5);
    EXPECT_NEAR(found->linear.value, 0.3614399, 2e-5);
    EXPECT_NEAR(found->linear.standardError, 0.3245079, 2e-4);
    EXPECT_NEAR(found->quadratic.value, 0.0404910, 2e-5);
    EXPECT_NEAR(found->scale.logLikelihood, -158.909686811, 1e-7);
    EXPECT_NEAR(found->scale.values(4), 1.8568483, 2e-5);
    EXPECT_NEAR(standardErrors(found->scale)(4), 0.2917935, 2e-4);
    EXPECT_EQ(found->scale.values(0), 0);
    EXPECT_EQ(found->scale.covariance(0, 0), 0);
    EXPECT_TRUE(found->isMonotone);
    EXPECT_EQ(found->scale.freedom, 20 - 6);
}

TEST(Boosted, RecoversTheScaleThatMadeTheShares) {
    const double truth[] = {0.5, 2.4, 0, 1.1, 1.7}; // boosted JND; the source is item 2
    Wins seen = Wins::Zero(5, 5), seenPlain = seen;
    const auto y = [](double x) { return 0.3 * x + 0.1 * x * x; };
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j)
            if (i != j) {
                seen(i, j) = 40 * distribution(Link::probit, jodUnit * (truth[i] - truth[j])).below;
                seenPlain(i, j) =
                    30 * distribution(Link::probit, jodUnit * (y(truth[i]) - y(truth[j]))).below;
            }
    const auto found = boostedScale(seen, seenPlain, 2);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->linear.value, 0.3, 1e-8);
    EXPECT_NEAR(found->quadratic.value, 0.1, 1e-8);
    for (int i = 0; i < 5; ++i)
        EXPECT_NEAR(found->scale.values(i), y(truth[i]), 1e-8);
    EXPECT_NEAR(found->scale.deviance, 0, 1e-8);
}

TEST(Boosted, WithoutPlainAnswersThereIsNoUnit) {
    EXPECT_FALSE(boostedScale(boosted, Wins::Zero(5, 5), 0));
    EXPECT_FALSE(boostedScale(Wins::Zero(5, 5), plain, 0));
    EXPECT_THROW(boostedScale(boosted, plain, 5), Error);
    EXPECT_THROW(boostedScale(boosted, Wins::Zero(4, 4), 0), Error);
}

} // namespace
} // namespace obscura
