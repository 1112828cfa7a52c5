#include "base/error.h"
#include "base/random.h"

#include "inference/psychometric.h"
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace obscura {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd vector(const std::vector<double>& values) {
    return VectorXd::Map(values.data(), static_cast<Index>(values.size()));
}

// Answers that rise from 0, and from 1/2 (two alternatives).
PsychometricData answers(double guess) {
    return {vector({.5, 1, 1.5, 2, 3, 4, 6, 8}),
            guess == 0 ? vector({1, 4, 6, 12, 15, 17, 18, 23})
                       : vector({9, 13, 11, 18, 17, 18, 18, 23}),
            vector({20, 22, 18, 25, 20, 20, 19, 24})};
}

// R 4.2.2: optim() of sum(dbinom(k, n, guess + (1 - guess - lapse) F(x), log = TRUE)), best of 36
// starts by Nelder-Mead, then BFGS; F is plogis(b (x - a)), pnorm(b (x - a)), 1 - exp(-(x / a)^b).
struct Row {
    Sigmoid curve;
    double guess;
    bool lapses;
    double threshold, slope, lapse, logLikelihood, deviance;
};
const Row rows[] = {
    {Sigmoid::logistic, 0, false, 2.33481712059, 0.93159207219, 0, -14.1726522548, 6.45329073638},
    {Sigmoid::logistic, 0, true, 2.05213021728, 1.41315409463, 0.05262632073, -11.5005244541,
     1.10903513495},
    {Sigmoid::logistic, .5, false, 2.70261237286, 0.678766611817, 0, -13.5055911547, 3.96893859793},
    {Sigmoid::logistic, .5, true, 2.1704400202, 1.46384686655, 0.050406975976, -11.952123296,
     0.862002880475},
    {Sigmoid::normal, 0, false, 2.43579641866, 0.48554339661, 0, -15.6594373385, 9.4268609036},
    {Sigmoid::normal, 0, true, 2.06763560313, 0.834894262135, 0.0543870302126, -11.507679392,
     1.12334501066},
    {Sigmoid::normal, .5, false, 2.80755502044, 0.371514561032, 0, -13.8602855872, 4.67832746282},
    {Sigmoid::normal, .5, true, 2.18356322345, 0.865263580634, 0.0511941751042, -11.9549746924,
     0.867705673287},
    {Sigmoid::weibull, 0, false, 2.78451966069, 1.38745134681, 0, -12.1397550599, 2.38749634648},
    {Sigmoid::weibull, 0, true, 2.44540016943, 1.75637096824, 0.0439822900746, -11.0086370744,
     0.125260375473},
    {Sigmoid::weibull, .5, false, 3.21041374339, 1.24632810161, 0, -12.4511568799, 1.86007004828},
    {Sigmoid::weibull, .5, true, 2.5579098128, 1.94987051184, 0.0466038238505, -11.8011832538,
     0.560122796138},
};

PsychometricModel modelOf(const Row& row) {
    PsychometricModel model{.curve = row.curve, .guess = row.guess};
    if (row.lapses)
        model.lapse.reset();
    return model;
}

TEST(Psychometric, EqualsR) {
    for (const Row& row : rows) {
        SCOPED_TRACE(::testing::Message()
                     << static_cast<int>(row.curve) << ' ' << row.guess << ' ' << row.lapses);
        const PsychometricFit fit = fitPsychometric(answers(row.guess), modelOf(row));
        EXPECT_TRUE(fit.converged);
        EXPECT_NEAR(fit.parameters.threshold, row.threshold, 2e-6);
        EXPECT_NEAR(fit.parameters.slope, row.slope, 2e-6);
        EXPECT_NEAR(fit.parameters.lapse, row.lapse, 2e-7);
        EXPECT_NEAR(fit.logLikelihood, row.logLikelihood, 1e-9);
        EXPECT_NEAR(fit.deviance, row.deviance, 1e-9);
        EXPECT_EQ(fit.df, row.lapses ? 5 : 6);
    }
}

// glm(cbind(k, n - k) ~ x, binomial), and MASS::dose.p for the error of the threshold.
TEST(Psychometric, ErrorsEqualGlm) {
    const PsychometricFit fit = fitPsychometric(answers(0), {});
    EXPECT_NEAR(fit.thresholdError.value_or(0), 0.218886673191, 1e-6);
    EXPECT_NEAR(fit.slopeError.value_or(0), 0.15831922263, 1e-6);
}

// R: uniroot() of the profile of the same likelihood.
TEST(Psychometric, ProfileIntervalsEqualR) {
    const auto expect = [](const PsychometricData& data, const PsychometricModel& model,
                           const std::vector<double>& threshold, const std::vector<double>& slope) {
        const PsychometricFit fit = fitPsychometric(data, model);
        OpenInterval bounds = profileInterval(data, model, fit, PsychometricParameter::threshold);
        EXPECT_NEAR(bounds.low.value_or(0), threshold[0], 2e-6);
        EXPECT_NEAR(bounds.high.value_or(0), threshold[1], 2e-6);
        bounds = profileInterval(data, model, fit, PsychometricParameter::slope);
        EXPECT_NEAR(bounds.low.value_or(0), slope[0], 2e-6);
        EXPECT_NEAR(bounds.high.value_or(0), slope[1], 2e-6);
    };
    expect(answers(0), {}, {1.90963167842, 2.79203472649}, {0.652134039713, 1.27478333284});
    expect(answers(0), {.curve = Sigmoid::weibull, .lapse = std::nullopt},
           {1.95688205225, 3.12022042265}, {1.16615924842, 2.57693476486});
    expect(answers(.5), {.curve = Sigmoid::normal, .guess = .5, .lapse = 0.02},
           {1.65988615001, 3.37596574851}, {0.292620714055, 1.43713188096});
}

TEST(Psychometric, LevelsInvertProbabilities) {
    for (const Row& row : rows) {
        const PsychometricModel model = modelOf(row);
        const Psychometric at{.threshold = row.threshold, .slope = row.slope, .lapse = row.lapse};
        for (const double p : {0.55, 0.75, 0.9})
            EXPECT_NEAR(probability(model, at, levelOf(model, at, p).value_or(0)), p, 1e-12);
        EXPECT_FALSE(levelOf(model, at, row.guess));
        EXPECT_FALSE(levelOf(model, at, 1 - row.lapse));
        const double middle = row.curve == Sigmoid::weibull ? 1 - std::exp(-1) : 0.5;
        EXPECT_NEAR(probability(model, at, at.threshold),
                    row.guess + (1 - row.guess - row.lapse) * middle, 1e-12);
    }
}

// The lapse rate stays in [0, 0.1]: nobody who fails half of the easiest trials fits it.
TEST(Psychometric, LapseStaysInItsBounds) {
    const PsychometricData wild{vector({1, 2, 3, 4, 5, 6}), vector({0, 2, 9, 14, 15, 13}),
                                vector({20, 20, 20, 20, 20, 20})};
    const PsychometricFit high = fitPsychometric(wild, {.lapse = std::nullopt});
    EXPECT_NEAR(high.parameters.lapse, 0.1, 1e-9);
    EXPECT_TRUE(high.converged);
    const PsychometricData perfect{vector({1, 2, 3, 4, 5, 6}), vector({0, 2, 9, 17, 20, 20}),
                                   vector({20, 20, 20, 20, 20, 20})};
    const PsychometricFit low = fitPsychometric(perfect, {.lapse = std::nullopt});
    EXPECT_NEAR(low.parameters.lapse, 0, 1e-9);
    EXPECT_TRUE(low.converged);
    EXPECT_NEAR(low.parameters.threshold, fitPsychometric(perfect, {}).parameters.threshold, 1e-6);
}

TEST(Psychometric, StepsAndFlatDataAreSaidAndFinite) {
    const std::vector<std::vector<double>> cases = {
        {0, 0, 0, 10, 10, 10}, {10, 10, 10, 10, 10, 10}, {0, 0, 0, 0, 0, 0},
        {5, 5, 5, 5, 5, 5},    {9, 8, 6, 4, 2, 1},
    };
    for (const auto& successes : cases)
        for (const Sigmoid curve : {Sigmoid::logistic, Sigmoid::normal, Sigmoid::weibull})
            for (const std::optional<double> lapse :
                 {std::optional(0.0), std::optional<double>()}) {
                const PsychometricData data{vector({1, 2, 3, 4, 5, 6}), vector(successes),
                                            VectorXd::Constant(6, 10)};
                const PsychometricModel model{.curve = curve, .lapse = lapse};
                const PsychometricFit fit = fitPsychometric(data, model);
                EXPECT_FALSE(fit.converged) << successes[0] << ' ' << static_cast<int>(curve);
                EXPECT_TRUE(std::isfinite(fit.parameters.threshold) &&
                            std::isfinite(fit.parameters.slope) &&
                            std::isfinite(fit.logLikelihood) && std::isfinite(fit.deviance));
                EXPECT_FALSE(fit.thresholdError || fit.slopeError);
            }
}

// 80 people who follow the curve: the bootstrap's interval is near the profile's, and the deviance
// is unremarkable; of answers that no curve of the kind can give it is remarkable.
TEST(Psychometric, BootstrapAgreesWithProfile) {
    const PsychometricData data = answers(0);
    const PsychometricModel model{.curve = Sigmoid::weibull};
    const PsychometricFit fit = fitPsychometric(data, model);
    const OpenInterval profile =
        profileInterval(data, model, fit, PsychometricParameter::threshold);
    const PsychometricBootstrap boot = bootstrapPsychometric(data, model, fit, 400, 7);
    EXPECT_EQ(boot.usable, 400);
    EXPECT_NEAR(boot.threshold.low.value_or(0), profile.low.value_or(9), 0.1);
    EXPECT_NEAR(boot.threshold.high.value_or(0), profile.high.value_or(9), 0.1);
    EXPECT_GT(boot.devianceP, 0.2);
    EXPECT_EQ(boot.threshold.low, bootstrapPsychometric(data, model, fit, 400, 7).threshold.low);

    const PsychometricData odd{vector({1, 2, 3, 4, 5}), vector({2, 30, 5, 30, 38}),
                               VectorXd::Constant(5, 40)};
    const PsychometricFit bad = fitPsychometric(odd, {});
    EXPECT_LT(bootstrapPsychometric(odd, {}, bad, 200, 7).devianceP, 0.01);
}

TEST(Psychometric, WrongInputIsNamed) {
    PsychometricData data = answers(0);
    EXPECT_THROW(fitPsychometric(data, {.guess = 1}), Error);
    EXPECT_THROW(fitPsychometric(data, {.lapse = 0.2}), Error);
    data.level[0] = -1;
    EXPECT_THROW(fitPsychometric(data, {.curve = Sigmoid::weibull}), Error);
    data.level.setConstant(3);
    EXPECT_THROW(fitPsychometric(data, {}), Error);
}

} // namespace
} // namespace obscura
