#include "base/error.h"
#include "tests/inference/matrices.h"

#include "inference/plackett_luce.h"
#include "inference/ties.h"

namespace obscura {
namespace {

const Wins wins =
    square({0, 3, 0, 1, 4, 5, 0, 2, 2, 1, 6, 7, 0, 2, 3, 4, 1, 9, 0, 5, 2, 8, 1, 3, 0});
const Eigen::MatrixXd ties =
    square({0, 2, 0, 1, 0, 2, 0, 3, 2, 1, 0, 3, 0, 4, 2, 1, 2, 4, 0, 3, 0, 1, 2, 3, 0});

TEST(Ties, DavidsonAgreesWithR) {
    // psychotools::btmodel(undecided = TRUE, type = "loglin"); errors from the exact likelihood's
    // optimHess(ndeps 1e-4)
    const auto found = davidson(wins, ties);
    ASSERT_TRUE(found);
    const Scale scale = relativeTo(found->scale, 0);
    expectNear(scale.values, {0, 0.2172849062, 1.2725088268, 1.6463451302, 0.9305255173}, 5e-7);
    expectNear(standardErrors(scale), {0, 0.5275122, 0.5729692, 0.5956823, 0.5753733}, 5e-6);
    EXPECT_NEAR(scale.logLikelihood, -86.3021718331, 1e-9);
    EXPECT_NEAR(found->ties->value, 0.57138291, 5e-7);
    EXPECT_NEAR(found->ties->standardError, 0.1542792, 5e-6);
    EXPECT_EQ(scale.freedom, 2 * 10 - 5);
}

TEST(Ties, ThresholdsAgreeWithR) {
    // ordinal::clm(y ~ D, link, threshold = "symmetric2")
    const auto logit = thresholdScale(wins, ties, Link::logit);
    ASSERT_TRUE(logit);
    const Scale raoKupper = relativeTo(logit->scale, 0);
    expectNear(raoKupper.values, {0, 0.2462478831, 1.0898955434, 1.3722433746, 0.8581032166}, 1e-8);
    expectNear(standardErrors(raoKupper),
               {0, 0.435492097660, 0.466609451544, 0.482764713098, 0.485864183298}, 1e-7);
    EXPECT_NEAR(raoKupper.logLikelihood, -86.2480351124, 1e-9);
    EXPECT_NEAR(logit->ties->value, 0.472830849763, 1e-8);
    EXPECT_NEAR(logit->ties->standardError, 0.102841838663, 1e-7);

    const auto probit = thresholdScale(wins, ties, Link::probit);
    ASSERT_TRUE(probit);
    const Scale glennDavid = inUnits(relativeTo(probit->scale, 0), 1 / jodUnit);
    expectNear(glennDavid.values, {0, 0.1321259088, 0.6522375579, 0.8190703797, 0.4877393503},
               1e-8);
    expectNear(standardErrors(glennDavid),
               {0, 0.262136628965, 0.282397661922, 0.283180063059, 0.283083143992}, 1e-7);
    EXPECT_NEAR(probit->ties->value * jodUnit, 0.287707767895, 1e-8);
}

TEST(Ties, WithoutTiesItIsTheModelWithoutThem) {
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(5, 5);
    const auto found = davidson(wins, none);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->ties);
    EXPECT_TRUE(found->scale.values.isApprox(bradleyTerry(wins)->values, 1e-12));
    EXPECT_NEAR(found->scale.deviance, bradleyTerry(wins)->deviance, 1e-9);
    EXPECT_TRUE(thresholdScale(wins, none, Link::probit)
                    ->scale.values.isApprox(thurstone(wins)->values, 1e-12));
}

TEST(Ties, EqualItemsWithTiesByHand) {
    // Two equal items, 6 wins each and 8 ties: nu / (2 + nu) = 0.4, F(t) - F(-t) = 0.4.
    const Wins even = square({0, 6, 6, 0});
    const Eigen::MatrixXd eight = square({0, 8, 8, 0});
    EXPECT_NEAR(davidson(even, eight)->ties->value, 4.0 / 3, 1e-9);
    EXPECT_NEAR(thresholdScale(even, eight, Link::logit)->ties->value, std::log(0.7 / 0.3), 1e-9);
    EXPECT_NEAR(thresholdScale(even, eight, Link::probit)->ties->value * jodUnit,
                quantile(Link::probit, 0.7), 1e-9);
    EXPECT_NEAR(davidson(even, eight)->scale.deviance, 0, 1e-9);
}

TEST(Ties, WithoutAFiniteMaximumThereIsNone) {
    const Eigen::MatrixXd three = square({0, 3, 3, 0});
    EXPECT_FALSE(davidson(Wins::Zero(2, 2), three)) << "only ties";
    EXPECT_FALSE(thresholdScale(Wins::Zero(2, 2), three, Link::probit));
    const Wins never = square({0, 5, 0, 0}); // one never won, though they tied
    EXPECT_FALSE(davidson(never, three));
    EXPECT_FALSE(thresholdScale(never, three, Link::logit));
    EXPECT_FALSE(thresholdScale(never, three, Link::probit));
    EXPECT_FALSE(davidson(Wins::Zero(2, 2), Wins::Zero(2, 2)));
}

TEST(Ties, OneBetweenItemsFarApartIsNotRoundedAway) {
    // Each beats the next 99999 times in 100000, and once the best and the worst of four tied,
    // some ten standard deviations apart. Numbering the items from the other end changes nothing.
    Wins chain = Wins::Zero(4, 4);
    for (int i = 1; i < 4; ++i) {
        chain(i, i - 1) = 99999;
        chain(i - 1, i) = 1;
    }
    Eigen::MatrixXd tie = Eigen::MatrixXd::Zero(4, 4);
    tie(0, 3) = tie(3, 0) = 1;
    for (const Link link : {Link::logit, Link::probit}) {
        const auto upward = thresholdScale(chain, tie, link);
        const auto downward = thresholdScale(chain.reverse(), tie.reverse(), link);
        ASSERT_TRUE(upward && downward);
        EXPECT_GT(upward->scale.values(3) - upward->scale.values(0), 10);
        EXPECT_TRUE(upward->scale.values.isApprox(downward->scale.values.reverse(), 1e-7));
        EXPECT_NEAR(upward->ties->value, downward->ties->value, 1e-7 * upward->ties->value);
    }
}

TEST(Ties, RefuseTiesThatAreNotMutual) {
    EXPECT_THROW(davidson(square({0, 1, 1, 0}), square({0, 2, 1, 0})), Error);
    EXPECT_THROW(davidson(square({0, 1, 1, 0}), Wins::Zero(3, 3)), Error);
}

const std::vector<Ranking> rankings = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 1}, {3, 1, 0, 2},
                                       {0, 2, 1, 3}, {1, 3},       {2, 3, 0}, {0, 3, 1, 2}};

TEST(Ranks, PlackettLuceIsTheLikelihoodsMaximum) {
    // R 4.2.2, optim(BFGS, reltol 1e-16) and optimHess of the likelihood as Luce wrote it
    const auto scale = plackettLuce(4, rankings);
    ASSERT_TRUE(scale);
    const Scale fromFirst = relativeTo(*scale, 0);
    expectNear(fromFirst.values, {0, -0.2879961, -0.9177790, -0.9111941}, 2e-6);
    expectNear(standardErrors(fromFirst), {0, 0.6961035, 0.7306144, 0.7504975}, 5e-6);
    EXPECT_NEAR(scale->logLikelihood, -18.9636707319, 1e-9);
    EXPECT_FALSE(fitTest(*scale));
    EXPECT_NEAR(*equalityTest(*scale).statistic,
                2 * (5 * std::log(24) + 2 * std::log(6) + std::log(2) - 18.9636707319), 1e-8);
}

TEST(Ranks, OfTwoAreComparisons) {
    const std::vector<Ranking> pairs = {{0, 1}, {0, 1}, {1, 0}, {1, 2}, {2, 1}, {2, 0}};
    const auto ranked = plackettLuce(3, pairs), compared = bradleyTerry(winsOf(3, pairs));
    EXPECT_TRUE(ranked->values.isApprox(compared->values, 1e-8));
    EXPECT_TRUE(ranked->covariance.isApprox(compared->covariance, 1e-8));
}

TEST(Ranks, WhereSomebodyIsAlwaysLastThereIsNone) {
    EXPECT_FALSE(plackettLuce(3, std::vector<Ranking>{{0, 1, 2}, {1, 0, 2}}));
    EXPECT_THROW(plackettLuce(3, std::vector<Ranking>{{0, 0, 2}}), Error);
    EXPECT_THROW(plackettLuce(3, std::vector<Ranking>{{0, 3}}), Error);
}

} // namespace
} // namespace obscura
