#include "base/error.h"
#include "tests/inference/matrices.h"

#include "inference/scales.h"

namespace obscura {
namespace {

// The tournament of shared golden/: None, Crytek24, Blizzard24, RayMarching30.
const Wins tournament = square({0, 10, 6, 6, 14, 0, 10, 5, 18, 14, 0, 12, 18, 19, 12, 0});

// Unbalanced: items 1 and 3 never met, two pairs were unanimous.
const Wins uneven =
    square({0, 3, 0, 1, 4, 5, 0, 2, 0, 1, 6, 7, 0, 2, 3, 4, 0, 9, 0, 5, 2, 8, 1, 3, 0});

TEST(Scales, BradleyTerryAgreesWithR) {
    // BradleyTerry2::BTm(cbind(w1, w2), p1, p2, refcat = "None")
    const auto scale = bradleyTerry(tournament);
    ASSERT_TRUE(scale);
    EXPECT_NEAR(scale->values.sum(), 0, 1e-12);
    const Scale fromNone = relativeTo(*scale, 0);
    expectNear(fromNone.values, {0, 0.324988554951, 0.993611338547, 1.22529014542}, 1e-9);
    expectNear(standardErrors(fromNone), {0, 0.306670737463, 0.315879398478, 0.323729584049}, 1e-8);
    EXPECT_NEAR(scale->deviance, 1.88306065926, 1e-9);
    const auto fit = fitTest(*scale);
    EXPECT_EQ(fit->df, 3);
    EXPECT_NEAR(fit->p, 0.597, 5e-4);
    EXPECT_NEAR(*equalityTest(*scale).statistic, 20.722012, 5e-7);
    EXPECT_NEAR(equalityTest(*scale).p, 0.000120, 5e-7);
}

TEST(Scales, ThurstoneAgreesWithR) {
    // glm(cbind(w1, w2) ~ 0 + D[, -1], binomial("probit")), over qnorm(0.75)
    const Scale scale = relativeTo(thurstone(tournament).value(), 0);
    expectNear(scale.values, {0, 0.292984166179, 0.905972342467, 1.11868732395}, 1e-9);
    expectNear(standardErrors(scale), {0, 0.277891298122, 0.282629656221, 0.287145220569}, 1e-8);
    EXPECT_NEAR(difference(scale, 2, 1).value, 0.6130, 5e-5);
    EXPECT_NEAR(differenceTest(scale, 2, 1).p, 0.0270, 5e-5);
    EXPECT_NEAR(difference(scale, 3, 2).value, 0.2127, 5e-5);
    EXPECT_NEAR(differenceTest(scale, 3, 2).p, 0.4431, 5e-5);
}

TEST(Scales, UnbalancedAndUnanimousPairsAgreeWithR) {
    // glm(cbind(k, n - k) ~ 0 + X[, -1], binomial(link)), epsilon 1e-15
    const Scale logit = relativeTo(bradleyTerry(uneven).value(), 0);
    expectNear(logit.values, {0, -0.134601122629, 1.288138826898, 2.018874004441, 0.809472019423},
               1e-9);
    expectNear(standardErrors(logit),
               {0, 0.536491358345, 0.584030918296, 0.657078430123, 0.563688069338}, 1e-8);
    EXPECT_NEAR(logit.covariance(1, 2), 0.152597432181, 1e-8);
    EXPECT_NEAR(logit.deviance, 11.1428444084, 1e-9);
    EXPECT_NEAR(logit.nullDeviance, 26.9397746055, 1e-9);
    EXPECT_EQ(logit.freedom, 9 - 4);
    const Scale probit = inUnits(relativeTo(thurstone(uneven).value(), 0), 1 / jodUnit);
    expectNear(probit.values,
               {0, -0.0924550630744, 0.7740840668165, 1.2077564533771, 0.4922235819802}, 1e-9);
    expectNear(standardErrors(probit),
               {0, 0.325602968863, 0.341935998558, 0.380096452887, 0.336991306106}, 1e-8);
    EXPECT_NEAR(probit.deviance, 11.226943002, 1e-9);
}

TEST(Scales, TheReferenceChangesNoDifference) {
    const auto scale = thurstone(uneven).value();
    for (int reference = 0; reference < 5; ++reference) {
        const Scale other = relativeTo(scale, reference);
        EXPECT_EQ(other.values(reference), 0);
        EXPECT_NEAR(other.covariance(reference, reference), 0, 1e-15);
        EXPECT_NEAR(difference(other, 3, 1).value, difference(scale, 3, 1).value, 1e-12);
        EXPECT_NEAR(difference(other, 3, 1).standardError, difference(scale, 3, 1).standardError,
                    1e-12);
    }
}

TEST(Scales, LeastSquaresAndMostellerAgreeWithR) {
    const auto jods = thurstoneLeastSquares(tournament);
    ASSERT_TRUE(jods);
    expectNear(jods->array() - (*jods)(0), {0, 0.276946422434, 0.905990802074, 1.12904437964},
               1e-10);
    const auto test = mosteller(tournament, *jods);
    EXPECT_NEAR(*test->statistic, 1.89536696931, 1e-9);
    EXPECT_EQ(test->df, 3);
    EXPECT_FALSE(thurstoneLeastSquares(uneven)) << "a unanimous pair has an infinite probit";
    // A chain has no degree of freedom: its distances are the probits, 1 and 2 JOD.
    const double share = 0.9113; // Phi(2 * 0.6745)
    const Wins chain = square({0, 1, 0, 3, 0, 1 - share, 0, share, 0});
    const auto exact = thurstoneLeastSquares(chain);
    EXPECT_NEAR((*exact)(1) - (*exact)(0), 1, 1e-12);
    EXPECT_NEAR((*exact)(2) - (*exact)(1), 2, 1e-3);
    EXPECT_FALSE(mosteller(chain, *exact));
    EXPECT_FALSE(fitTest(thurstone(chain).value()));
}

TEST(Scales, GroupsThatWereNeverComparedAreNamed) {
    // 0 and 2 met, 1 and 4 met, 3 met nobody.
    Wins wins = Wins::Zero(5, 5);
    wins(0, 2) = wins(2, 0) = 3;
    wins(1, 4) = 2;
    const Connection found = connection(wins);
    EXPECT_EQ(found.groups, sets({{0, 2}, {1, 4}, {3}}));
    EXPECT_FALSE(bradleyTerry(wins));
    EXPECT_FALSE(thurstone(wins, 2.0)) << "a prior alone must not place groups";
    EXPECT_FALSE(thurstoneLeastSquares(wins));
    wins(3, 4) = wins(0, 1) = 1; // one comparison joins them; nobody ever won the other way
    EXPECT_EQ(connection(wins).groups, sets({{0, 1, 2, 3, 4}}));
    EXPECT_EQ(connection(wins).tiers.size(), 4u);
    EXPECT_FALSE(bradleyTerry(wins));
    EXPECT_TRUE(bradleyTerry(wins, 2.0));
}

TEST(Scales, TiersStandFromBestToWorst) {
    // 3 beat all, always; 0, 2 and 4 beat each other in a circle; 1 never won.
    Wins wins = Wins::Zero(5, 5);
    wins(3, 0) = wins(3, 4) = wins(0, 2) = wins(2, 4) = wins(4, 0) = wins(2, 1) = wins(3, 1) = 1;
    EXPECT_EQ(connection(wins).tiers, sets({{3}, {0, 2, 4}, {1}}));
}

TEST(Scales, WhoNeverWonHasAFinitePlaceByThePriorAlone) {
    const Wins wins = square({0, 0, 0, 4, 0, 3, 5, 2, 0});
    EXPECT_FALSE(bradleyTerry(wins));
    EXPECT_FALSE(thurstone(wins));
    // optim(BFGS, reltol 1e-16) of the penalised likelihood, sd 1.5 (JOD in the second)
    expectNear(bradleyTerry(wins, 1.5)->values, {-1.6367195, 0.9596769, 0.6770425}, 2e-6);
    expectNear(thurstone(wins, 1.5)->values, {-1.5980736, 0.9331258, 0.6649478}, 2e-6);
}

TEST(Scales, OneComparisonOfTwoItems) {
    const Wins one = square({0, 1, 0, 0});
    EXPECT_FALSE(thurstone(one));
    const auto scale = bradleyTerry(one, 1.0);
    // x = values(0) - values(1) maximises log F(x) - x^2 / 4: x / 2 = 1 - F(x).
    const double x = scale->values(0) - scale->values(1);
    EXPECT_NEAR(x / 2, 1 / (1 + std::exp(x)), 1e-12);
}

TEST(Scales, FiftyItemsFromTrueShares) {
    // Shares that the model predicts, so that the maximum is the truth; every fifth pair only.
    Wins wins = Wins::Zero(50, 50);
    for (int i = 0; i < 50; ++i)
        for (int j = 0; j < i; ++j)
            if ((i + j) % 5 == 0 || i == j + 1) {
                const double p = 1 / (1 + std::exp(-0.11 * (i - j)));
                wins(i, j) = 10 * p;
                wins(j, i) = 10 * (1 - p);
            }
    const auto scale = bradleyTerry(wins);
    ASSERT_TRUE(scale);
    for (int i = 0; i < 50; ++i)
        EXPECT_NEAR(scale->values(i), 0.11 * (i - 24.5), 1e-9);
    EXPECT_NEAR(scale->deviance, 0, 1e-9);
}

TEST(Scales, ManyRareUpsetsStillHaveAMaximum) {
    // A chain of 50 in which the lower wins once in 1000: 49 steps of log(999).
    Wins wins = Wins::Zero(50, 50);
    for (int i = 1; i < 50; ++i) {
        wins(i, i - 1) = 999;
        wins(i - 1, i) = 1;
    }
    const auto scale = bradleyTerry(wins);
    ASSERT_TRUE(scale);
    EXPECT_NEAR(difference(*scale, 49, 0).value, 49 * std::log(999), 1e-6);
    EXPECT_NEAR(difference(*scale, 1, 0).standardError, std::sqrt(1000.0 / 999), 1e-7);
    EXPECT_TRUE(thurstone(wins));
}

TEST(Scales, RefuseWhatIsNoTable) {
    EXPECT_THROW(connection(Wins::Zero(1, 1)), Error);
    EXPECT_THROW(connection(Wins::Zero(2, 3)), Error);
    EXPECT_THROW(bradleyTerry(square({1, 2, 3, 0})), Error);
    EXPECT_THROW(bradleyTerry(square({0, -2, 3, 0})), Error);
    EXPECT_THROW(bradleyTerry(square({0, std::nan(""), 3, 0})), Error);
    EXPECT_THROW(bradleyTerry(square({0, 2, 3, 0}), 0.0), Error);
    EXPECT_THROW(relativeTo(bradleyTerry(square({0, 2, 3, 0})).value(), 2), Error);
    EXPECT_THROW(differenceTest(bradleyTerry(square({0, 2, 3, 0})).value(), 1, 1), Error);
    EXPECT_FALSE(bradleyTerry(Wins::Zero(3, 3)));
}

} // namespace
} // namespace obscura
