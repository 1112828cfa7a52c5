#include "base/error.h"
#include "tests/inference/simulated_people.h"
#include "tests/inference/trials_28x7.h"

#include "inference/mixed.h"
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace obscura {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// lme4 1.1-31, glmerControl("bobyqa", optCtrl = list(rhobeg = .2, rhoend = 1e-9), tolPwrss = 1e-12)
struct Expected {
    std::vector<double> coefficients, errors;
    double sd, logLikelihood;
};

void expectFit(const MixedFit& fit, const Expected& expected, double tolerance,
               double errorTolerance) {
    EXPECT_TRUE(fit.converged);
    EXPECT_FALSE(fit.separated || fit.boundary);
    EXPECT_NEAR(fit.sd, expected.sd, tolerance);
    EXPECT_NEAR(fit.logLikelihood, expected.logLikelihood, tolerance);
    for (std::size_t i = 0; i < expected.coefficients.size(); ++i) {
        const auto j = static_cast<Index>(i);
        EXPECT_NEAR(fit.coefficients[j], expected.coefficients[i], tolerance) << i;
        EXPECT_NEAR(std::sqrt(fit.covariance(j, j)), expected.errors[i], errorTolerance) << i;
    }
}

TEST(Mixed, GoldenStudyEqualsLme4) {
    const Study study = trials28x7({1, 2, 3, 4, 5, 6, 7});
    expectFit(fitMixed(study.data, study.person),
              {{0.4652618496473, 0.3112563267416, 0.9762454873516, -0.0003768595627921,
                1.616787926073, -0.3119672160905, 0.0002534832080971, 0.5837459069068},
               {0.4110365760262, 0.4085185439348, 0.4431690825873, 0.404283086606, 0.5184216823393,
                0.4085319494327, 0.4017029818567, 0.3146602861332},
               0.4907041612012,
               -123.486961552},
              2e-7, 2e-6);
    expectFit(fitMixed(study.data, study.person, {.points = 1}),
              {{0.4640692159563, 0.3101490198822, 0.9735956723976, -0.0005048520255685,
                1.611654919539, -0.3111016517142, 6.421094475012e-05, 0.5814436538581},
               {0.4095107320141, 0.4068075996722, 0.4414867726725, 0.4025930478726, 0.51629946793,
                0.4068414243973, 0.4002119579074, 0.3141906616879},
               0.4653609152844,
               -123.540381202},
              2e-7, 2e-6);
    const Study null = withoutConditions(study);
    const MixedFit without = fitMixed(null.data, null.person);
    EXPECT_NEAR(without.logLikelihood, -130.6752068332, 1e-8);
    const auto test =
        likelihoodRatio(without.logLikelihood, fitMixed(study.data, study.person).logLikelihood, 6);
    EXPECT_NEAR(test.statistic.value_or(0), 14.3765, 1e-4);
    EXPECT_NEAR(test.p, 0.02570, 1e-5);
}

// H3: does the level matter for the Crytek pairs?
TEST(Mixed, GoldenLevelsEqualLme4) {
    const Study study = trials28x7({1, 3, 6}), null = withoutConditions(study);
    const MixedFit fit = fitMixed(study.data, study.person);
    EXPECT_NEAR(fit.sd, 1.787210415458, 1e-6);
    EXPECT_NEAR(fit.logLikelihood, -50.48809401683, 1e-8);
    const double without = fitMixed(null.data, null.person).logLikelihood;
    EXPECT_NEAR(without, -54.01390654397, 1e-8);
    EXPECT_NEAR(likelihoodRatio(without, fit.logLikelihood, 2).p, 0.02943, 1e-5);
}

TEST(Mixed, UnbalancedLogitEqualsLme4) {
    const Study study = unbalancedPeople();
    ASSERT_EQ(study.data.successes.sum(), 71);
    ASSERT_NEAR(study.data.design.col(1).sum(), 1.7, 1e-12);
    expectFit(fitMixed(study.data, study.person, {.points = 1}),
              {{0.990601195300841, 0.146103130189514},
               {0.306466780066071, 0.223412503197761},
               0.749594898211,
               -57.948278213},
              2e-6, 2e-5);
    expectFit(fitMixed(study.data, study.person, {.points = 5}),
              {{0.991718577471467, 0.153803472810194},
               {0.314473569236699, 0.225482761056571},
               0.801363191468,
               -57.8606898076},
              2e-6, 2e-5);
    const MixedFit fit = fitMixed(study.data, study.person);
    expectFit(fit,
              {{0.991814877798289, 0.153886116448178},
               {0.314599926986618, 0.225516296485965},
               0.801958848282,
               -57.8601932098},
              2e-6, 2e-5);
    EXPECT_NEAR(fit.persons[0], 0.126168366801, 1e-5);
    EXPECT_NEAR(fit.persons[1], -0.601921238471, 1e-5);
}

TEST(Mixed, UnbalancedProbitEqualsLme4) {
    const Study study = unbalancedPeople();
    expectFit(fitMixed(study.data, study.person, {.link = Link::probit, .points = 1}),
              {{0.606679385014922, 0.0831946521927541},
               {0.181397786525329, 0.133268009198685},
               0.44545170067,
               -57.9615414679},
              2e-6, 2e-5);
    expectFit(fitMixed(study.data, study.person, {.link = Link::probit}),
              {{0.598439110663529, 0.0874126679132163},
               {0.183682716225775, 0.132559007529728},
               0.475776701526,
               -57.8505431063},
              2e-6, 2e-5);
}

// R's integrate() over each person and optim() give what many points must converge to.
TEST(Mixed, ManyPointsGiveTheIntegral) {
    const Study study = unbalancedPeople();
    const MixedFit fit = fitMixed(study.data, study.person, {.points = 40});
    EXPECT_NEAR(fit.coefficients[0], 0.991814926251, 1e-6);
    EXPECT_NEAR(fit.coefficients[1], 0.153886156554, 1e-6);
    EXPECT_NEAR(fit.sd, 0.801959037742, 1e-6);
    EXPECT_NEAR(fit.logLikelihood, -57.860193209, 1e-8);
}

TEST(Mixed, HugeVarianceEqualsLme4) {
    const Study study = simulatePeople(
        25, [](int) { return 12; }, 8, 1, 2, 99);
    ASSERT_EQ(study.data.successes.sum(), 136);
    expectFit(fitMixed(study.data, study.person),
              {{-0.632781666871272, 1.87559523247553},
               {2.51608996236476, 0.476105247798758},
               11.6456708706,
               -61.1055498735},
              1e-4, 1e-3);
}

// R: glmer gives sd 0 (singular) and glm's fit.
TEST(Mixed, PeopleWhoDoNotDifferGiveTheLogisticFit) {
    const Study study = simulatePeople(14, unequalRows, 1.2, 0.3, 0.8, 12345);
    ASSERT_EQ(study.data.successes.sum(), 28);
    for (const int points : {1, 15}) {
        const MixedFit fit = fitMixed(study.data, study.person, {.points = points});
        EXPECT_TRUE(fit.boundary && fit.converged);
        EXPECT_EQ(fit.sd, 0);
        EXPECT_FALSE(fit.sdError);
        EXPECT_NEAR(fit.coefficients[0], -0.188190704477, 1e-7);
        EXPECT_NEAR(fit.coefficients[1], 0.790439094162, 1e-7);
        EXPECT_NEAR(std::sqrt(fit.covariance(0, 0)), 0.275702938870117, 1e-6);
        EXPECT_NEAR(fit.logLikelihood, -39.0007538485, 1e-9);
    }
}

// Choices of a person under the same circumstances are a tally.
TEST(Mixed, TalliesEqualChoices) {
    const Study study = trials28x7({1, 2, 3});
    Study twice = study;
    const Index n = study.data.successes.size();
    twice.data.design.conservativeResize(2 * n, Eigen::NoChange);
    twice.data.design.bottomRows(n) = study.data.design;
    twice.data.successes.conservativeResize(2 * n);
    twice.data.successes.tail(n) = study.data.successes;
    twice.data.trials.setOnes(2 * n);
    twice.person.insert(twice.person.end(), study.person.begin(), study.person.end());
    Study tallies = study;
    tallies.data.successes *= 2;
    tallies.data.trials *= 2;
    const MixedFit a = fitMixed(twice.data, twice.person),
                   b = fitMixed(tallies.data, tallies.person);
    EXPECT_GT(a.sd, 1);
    EXPECT_NEAR(a.sd, b.sd, 1e-9);
    EXPECT_LT((a.coefficients - b.coefficients).norm(), 1e-9);
    EXPECT_NEAR(a.logLikelihood + logBinomialCoefficients(tallies.data), b.logLikelihood, 1e-9);
}

void expectFinite(const MixedFit& fit) {
    EXPECT_TRUE(fit.coefficients.allFinite() && fit.covariance.allFinite() &&
                fit.persons.allFinite() && std::isfinite(fit.sd) &&
                std::isfinite(fit.logLikelihood) && (!fit.sdError || std::isfinite(*fit.sdError)));
}

TEST(Mixed, OnePersonOrOneTrialEachIsTheLogisticFit) {
    Study study = unbalancedPeople();
    const GlmFit plain = fitGlm(study.data);
    std::vector<int> single(study.person.size(), 0), each;
    for (int i = 0; i < static_cast<int>(study.person.size()); ++i)
        each.push_back(i);
    for (const auto& person : {single, each}) {
        const MixedFit fit = fitMixed(study.data, person);
        EXPECT_FALSE(fit.identified);
        EXPECT_LT((fit.coefficients - plain.coefficients).norm(), 1e-10);
        EXPECT_NEAR(fit.logLikelihood, plain.logLikelihood, 1e-10);
        expectFinite(fit);
    }
}

TEST(Mixed, SeparatedDataAreSaidAndFinite) {
    for (const Link link : {Link::logit, Link::probit})
        for (const int points : {1, 15}) {
            Study study = unbalancedPeople();
            // All answers beyond x = 0.55 are yes, all others no.
            study.data.successes = (study.data.design.col(1).array() > 0.55).cast<double>();
            MixedFit fit = fitMixed(study.data, study.person, {.link = link, .points = points});
            EXPECT_TRUE(fit.separated);
            EXPECT_FALSE(fit.converged);
            EXPECT_NEAR(fit.logLikelihood, 0, 1e-7);
            expectFinite(fit);
            // Nobody disagrees with themselves: people differ without bound.
            for (std::size_t i = 0; i < study.person.size(); ++i)
                study.data.successes[static_cast<Index>(i)] = study.person[i] % 2;
            fit = fitMixed(study.data, study.person, {.link = link, .points = points});
            EXPECT_FALSE(fit.converged && fit.sd < 5);
            expectFinite(fit);
            // Everybody always says yes.
            study.data.successes = study.data.trials;
            fit = fitMixed(study.data, study.person, {.link = link, .points = points});
            EXPECT_TRUE(fit.separated);
            expectFinite(fit);
        }
}

// Everybody agrees on the fifth condition: its coefficient is infinite, the rest is as without it.
TEST(Mixed, OneUnanimousConditionLeavesTheOthers) {
    Study study = trials28x7({1, 3, 6, 5});
    for (Index i = 3; i < study.data.successes.size(); i += 4)
        study.data.successes[i] = 1;
    const MixedFit fit = fitMixed(study.data, study.person);
    EXPECT_TRUE(fit.separated);
    EXPECT_FALSE(fit.converged || fit.sdError);
    EXPECT_GT(fit.coefficients[3], 10);
    expectFinite(fit);
    const Study others = trials28x7({1, 3, 6});
    const MixedFit without = fitMixed(others.data, others.person);
    EXPECT_NEAR(fit.sd, without.sd, 1e-3);
    EXPECT_NEAR(fit.logLikelihood, without.logLikelihood, 1e-6);
}

TEST(Mixed, WrongInputIsNamed) {
    Study study = unbalancedPeople();
    study.person.pop_back();
    EXPECT_THROW(fitMixed(study.data, study.person), Error);
    study.person.push_back(-1);
    EXPECT_THROW(fitMixed(study.data, study.person), Error);
    study.person.back() = 3;
    EXPECT_THROW(fitMixed(study.data, study.person, {.points = 0}), Error);
}

} // namespace
} // namespace obscura
