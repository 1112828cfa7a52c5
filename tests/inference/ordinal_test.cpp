#include "base/error.h"
#include "tests/inference/simulated_people.h"

#include "inference/glm.h"
#include "inference/interval_evidence.h"
#include "inference/mixed.h"
#include "inference/ordinal.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace obscura {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

struct Ratings {
    OrdinalData data;
    std::vector<int> person;
};

// As simulatePeople, in four categories: sum(u01() >= plogis(thresholds - b1 x - b)).
Ratings simulateRatings(int persons, double sd, double b1, std::uint64_t seed) {
    ParkMiller random(seed);
    std::vector<double> x;
    Ratings ratings;
    for (int i = 0; i < persons; ++i) {
        const double b = sd * quantile(Link::probit, random.uniform());
        for (int j = 0; j < unequalRows(i); ++j) {
            x.push_back(std::round((4 * random.uniform() - 2) * 10) / 10);
            const double u = random.uniform();
            int category = 0;
            for (const double threshold : {-1.5, -0.2, 0.9})
                category += u >= distribution(Link::logit, threshold - b1 * x.back() - b).below;
            ratings.data.category.push_back(category);
            ratings.person.push_back(i);
        }
    }
    ratings.data.design = VectorXd::Map(x.data(), static_cast<Index>(x.size()));
    return ratings;
}

Ratings unequalRatings() { return simulateRatings(20, 1.2, 0.7, 4242); }

// Thresholds and coefficient; their standard errors.
void expectFit(const OrdinalFit& fit, const std::vector<double>& values,
               const std::vector<double>& errors, double logLikelihood, double tolerance,
               double errorTolerance) {
    EXPECT_TRUE(fit.converged);
    ASSERT_EQ(fit.thresholds.size(), 3);
    for (Index i = 0; i < 4; ++i) {
        const auto at = static_cast<std::size_t>(i);
        EXPECT_NEAR(i < 3 ? fit.thresholds[i] : fit.coefficients[0], values[at], tolerance) << i;
        EXPECT_NEAR(std::sqrt(fit.covariance(i, i)), errors[at], errorTolerance) << i;
    }
    EXPECT_NEAR(fit.logLikelihood, logLikelihood, tolerance);
}

// ordinal 2022.11-16: clm(y ~ x, link, control = clm.control(gradTol = 1e-12))
TEST(Ordinal, EqualsClm) {
    const Ratings ratings = unequalRatings();
    ASSERT_EQ(std::count(ratings.data.category.begin(), ratings.data.category.end(), 3), 42);
    expectFit(fitOrdinal(ratings.data),
              {-2.003564556929, -0.9744116534647, 0.3123393195766, 0.6038444525431},
              {0.3052766963254, 0.2331715417773, 0.212872333987, 0.1758066451775}, -121.4091937217,
              1e-9, 5e-8);
    expectFit(fitOrdinal(ratings.data, Link::probit),
              {-1.142859499744, -0.5678795578542, 0.2011029847412, 0.3290071717298},
              {0.1602041465598, 0.1368481000133, 0.1305996872686, 0.1026464907672}, -122.3846126921,
              1e-9, 5e-8);
}

// clmm(y ~ x + (1 | p), link, nAGQ, control = clmm.control(gradTol = 1e-8)). Its last standard
// error is of log sd.
TEST(Ordinal, MixedEqualsClmm) {
    const Ratings ratings = unequalRatings();
    OrdinalMixedFit fit = fitOrdinalMixed(ratings.data, ratings.person, Link::logit, 1);
    expectFit(fit, {-2.25952918372, -0.9591746183529, 0.6751905825362, 0.8203125465222},
              {0.5034663811429, 0.4455026452141, 0.4497243660291, 0.2251867458895}, -116.3751118246,
              6e-5, 2e-4);
    EXPECT_NEAR(fit.sd, 1.503694529703, 6e-5);
    EXPECT_NEAR(fit.sdError.value_or(0), 0.3303069072427 * fit.sd, 1e-4);
    fit = fitOrdinalMixed(ratings.data, ratings.person);
    expectFit(fit, {-2.261912926777, -0.9520361948955, 0.6901957682715, 0.8275503777471},
              {0.5152366392931, 0.4593891069592, 0.4646416546108, 0.2264984698891}, -116.0909160892,
              6e-5, 2e-4);
    EXPECT_NEAR(fit.sd, 1.57549390101, 6e-5);
    EXPECT_NEAR(fit.sdError.value_or(0), 0.3347787104248 * fit.sd, 1e-4);
    fit = fitOrdinalMixed(ratings.data, ratings.person, Link::probit, 1);
    expectFit(fit, {-1.312396865578, -0.5575470202291, 0.4095128681145, 0.4693920845941},
              {0.2896755589309, 0.2656685468382, 0.2677887459211, 0.1277949933373}, -116.0656748046,
              6e-5, 2e-4);
    EXPECT_NEAR(fit.sd, 0.9221246416873, 6e-5);
    fit = fitOrdinalMixed(ratings.data, ratings.person, Link::probit);
    expectFit(fit, {-1.313248533655, -0.5571517949438, 0.411052200752, 0.4703020801249},
              {0.2911925498368, 0.2672680731443, 0.2692785013196, 0.1278552246426}, -116.0153638587,
              6e-5, 2e-4);
}

// R's integrate() over each person and optim() say the same more exactly than clmm.
TEST(Ordinal, ManyPointsGiveTheIntegral) {
    const Ratings ratings = unequalRatings();
    OrdinalMixedFit fit = fitOrdinalMixed(ratings.data, ratings.person, Link::logit, 40);
    expectFit(fit, {-2.261922425862, -0.9520405873445, 0.6901799135732, 0.8275450221497},
              {0.5152324156189, 0.4593826844575, 0.4646344351558, 0.2264977635957}, -116.0909162625,
              2e-6, 2e-6);
    EXPECT_NEAR(fit.sd, 1.575464151761, 2e-6);
    fit = fitOrdinalMixed(ratings.data, ratings.person, Link::probit, 40);
    expectFit(fit, {-1.313250224409, -0.5571520946749, 0.4110492671062, 0.4703024696124},
              {0.2911925602122, 0.2672678339504, 0.269278129753, 0.1278552311383}, -116.0153638477,
              2e-6, 2e-6);
    EXPECT_NEAR(fit.sd, 0.9307452709767, 2e-6);
}

// clmm: sd 4e-5, logLik as clm's.
TEST(Ordinal, RatersWhoDoNotDifferGiveTheFixedFit) {
    const Ratings ratings = simulateRatings(14, 0, 0.7, 31);
    const OrdinalMixedFit fit = fitOrdinalMixed(ratings.data, ratings.person);
    EXPECT_TRUE(fit.boundary && fit.converged);
    EXPECT_EQ(fit.sd, 0);
    EXPECT_NEAR(fit.logLikelihood, -88.5345243342, 1e-9);
    EXPECT_NEAR(fit.thresholds[0], -1.675126644489, 1e-5);
}

// Two categories are a binomial regression with the intercept's sign turned.
TEST(Ordinal, TwoCategoriesAreTheBinomialModel) {
    const Study study = unbalancedPeople();
    OrdinalData data{.design = study.data.design.rightCols(1), .category = {}};
    for (Index i = 0; i < study.data.successes.size(); ++i)
        data.category.push_back(study.data.successes[i] > 0 ? 1 : 0);
    for (const Link link : {Link::logit, Link::probit}) {
        const GlmFit plain = fitGlm(study.data, {.link = link});
        const OrdinalFit fixed = fitOrdinal(data, link);
        EXPECT_NEAR(fixed.thresholds[0], -plain.coefficients[0], 1e-7);
        EXPECT_NEAR(fixed.logLikelihood, plain.logLikelihood, 1e-10);
        // With few points the scales (observed, expected information) differ; the integral does
        // not.
        const MixedFit mixed = fitMixed(study.data, study.person, {.link = link, .points = 30});
        const OrdinalMixedFit fit = fitOrdinalMixed(data, study.person, link, 30);
        EXPECT_NEAR(fit.sd, mixed.sd, 1e-6);
        EXPECT_NEAR(fit.coefficients[0], mixed.coefficients[1], 1e-6);
        EXPECT_NEAR(std::sqrt(fit.covariance(1, 1)), std::sqrt(mixed.covariance(1, 1)), 1e-6);
    }
}

TEST(Ordinal, IntervalDerivativesAreThoseOfTheFunction) {
    const double h = 1e-5;
    for (const Link link : {Link::logit, Link::probit})
        for (const auto& [hasLower, hasUpper] :
             {std::pair{true, true}, {true, false}, {false, true}})
            for (const double l : {-3.0, -0.4, 2.5}) {
                const double u = l + 0.9;
                const auto of = [&, lower = hasLower, upper = hasUpper](double dl, double du) {
                    return intervalEvidence(link, lower, l + dl, upper, u + du);
                };
                const IntervalEvidence at = of(0, 0);
                const auto slope = [&](double IntervalEvidence::*member, bool upper) {
                    return upper ? (of(0, h).*member - of(0, -h).*member) / (2 * h)
                                 : (of(h, 0).*member - of(-h, 0).*member) / (2 * h);
                };
                using E = IntervalEvidence;
                EXPECT_NEAR(at.u, slope(&E::value, true), 1e-8);
                EXPECT_NEAR(at.l, slope(&E::value, false), 1e-8);
                EXPECT_NEAR(at.uu, slope(&E::u, true), 1e-8);
                EXPECT_NEAR(at.ul, slope(&E::u, false), 1e-8);
                EXPECT_NEAR(at.ll, slope(&E::l, false), 1e-8);
                EXPECT_NEAR(at.uuu, slope(&E::uu, true), 1e-7);
                EXPECT_NEAR(at.uul, slope(&E::uu, false), 1e-7);
                EXPECT_NEAR(at.ull, slope(&E::ll, true), 1e-7);
                EXPECT_NEAR(at.lll, slope(&E::ll, false), 1e-7);
            }
}

// R: log(plogis(-20) - plogis(-21)), log(pnorm(-20) - pnorm(-20.5)), pnorm(-37, log.p = TRUE).
TEST(Ordinal, IntervalsFarInTheTailsAreExact) {
    const auto expectValue = [](const IntervalEvidence& of, double value) {
        EXPECT_NEAR(of.value, value, 1e-12 * std::abs(value));
    };
    expectValue(intervalEvidence(Link::logit, true, -21, true, -20), -20.45867514820649);
    expectValue(intervalEvidence(Link::logit, true, 20, true, 21), -20.45867514820649);
    expectValue(intervalEvidence(Link::probit, true, -20.5, true, -20), -203.917194464609);
    expectValue(intervalEvidence(Link::probit, true, 20, true, 20.5), -203.917194464609);
    expectValue(intervalEvidence(Link::probit, true, 37, false, 0), -689.0305855768906);
    for (const double far : {50.0, 1e3, 1e6})
        for (const Link link : {Link::logit, Link::probit}) {
            const IntervalEvidence of = intervalEvidence(link, true, far, true, far + 1);
            EXPECT_TRUE(std::isfinite(of.value) && std::isfinite(of.byShift()) &&
                        std::isfinite(of.byShift2()) && std::isfinite(of.byShift3()));
        }
}

TEST(Ordinal, SeparatedRatingsAreSaidAndFinite) {
    OrdinalData data{.design = VectorXd::LinSpaced(12, -1, 1), .category = {}};
    for (int i = 0; i < 12; ++i)
        data.category.push_back(i / 4);
    const std::vector<int> person{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2};
    for (const Link link : {Link::logit, Link::probit}) {
        const OrdinalMixedFit fit = fitOrdinalMixed(data, person, link);
        EXPECT_FALSE(fit.converged);
        EXPECT_TRUE(fit.thresholds.allFinite() && fit.coefficients.allFinite() &&
                    fit.covariance.allFinite() && std::isfinite(fit.sd));
        EXPECT_NEAR(fit.logLikelihood, 0, 1e-4);
        EXPECT_FALSE(fitOrdinal(data, link).converged);
    }
}

TEST(Ordinal, WrongInputIsNamed) {
    OrdinalData data{.design = VectorXd::LinSpaced(4, -1, 1), .category = {0, 1, 3, 1}};
    EXPECT_THROW(fitOrdinal(data), Error); // 2 is never used
    data.category = {0, 0, 0, 0};
    EXPECT_THROW(fitOrdinal(data), Error);
    data.category = {0, 1, 1, -1};
    EXPECT_THROW(fitOrdinal(data), Error);
    data.category = {0, 1, 1};
    EXPECT_THROW(fitOrdinal(data), Error);
    data.category = {0, 1, 1, 0};
    data.design.setOnes(); // an intercept, which the threshold is already
    EXPECT_THROW(fitOrdinal(data), Error);
    data.design.resize(4, 0); // thresholds alone
    EXPECT_NEAR(fitOrdinal(data).thresholds[0], 0, 1e-12);
}

} // namespace
} // namespace obscura
