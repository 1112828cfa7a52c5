#include "base/error.h"
#include "tests/inference/trials_28x7.h"

#include "inference/glm.h"
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace obscura {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Unbalanced tallies; the figures are R 4.2.2's
//   x <- c(-2.5,-1,-.3,0,.4,1.7,2.2,5); g <- c(0,0,1,1,0,1,0,1)
//   k <- c(0,3,1,5,2,9,1,7); n <- c(2,11,1,12,3,10,1,7)
//   f <- glm(cbind(k, n-k) ~ x + g, binomial(link), control = list(epsilon = 1e-15))
BinomialData tallies() {
    BinomialData data;
    data.design.resize(8, 3);
    data.design.col(0).setOnes();
    data.design.col(1) << -2.5, -1, -0.3, 0, 0.4, 1.7, 2.2, 5;
    data.design.col(2) << 0, 0, 1, 1, 0, 1, 0, 1;
    data.successes.resize(8);
    data.successes << 0, 3, 1, 5, 2, 9, 1, 7;
    data.trials.resize(8);
    data.trials << 2, 11, 1, 12, 3, 10, 1, 7;
    return data;
}

BinomialData choices(const std::vector<double>& x, const std::vector<double>& chosen) {
    BinomialData data;
    const auto rows = static_cast<Eigen::Index>(x.size());
    data.design.resize(rows, 2);
    data.design.col(0).setOnes();
    data.design.col(1) = VectorXd::Map(x.data(), rows);
    data.successes = VectorXd::Map(chosen.data(), rows);
    data.trials.setOnes(rows);
    return data;
}

void expectNear(const VectorXd& found, const std::vector<double>& expected, double tolerance) {
    ASSERT_EQ(found.size(), static_cast<Eigen::Index>(expected.size()));
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(found[static_cast<Eigen::Index>(i)], expected[i], tolerance) << i;
}

VectorXd errors(const MatrixXd& covariance) { return covariance.diagonal().cwiseSqrt(); }

TEST(Glm, LogitEqualsR) {
    const GlmFit fit = fitGlm(tallies());
    EXPECT_TRUE(fit.converged);
    EXPECT_FALSE(fit.separated);
    expectNear(fit.coefficients, {0.300720529802641, 1.350311613129, -0.416665038354133}, 1e-11);
    expectNear(errors(fit.covariance), {0.68923027268078, 0.509686871070645, 0.940620162342217},
               1e-10);
    EXPECT_NEAR(fit.covariance(0, 1), 0.180829160403291, 1e-10);
    EXPECT_NEAR(fit.logLikelihood, -5.78247671732535, 1e-11);
    EXPECT_NEAR(fit.deviance, 2.41602146533243, 1e-11);
}

TEST(Glm, ProbitEqualsR) {
    const GlmFit fit = fitGlm(tallies(), {.link = Link::probit});
    expectNear(fit.coefficients, {0.164836062082073, 0.799743438951526, -0.241932397260446}, 1e-8);
    expectNear(errors(fit.covariance), {0.401707330656852, 0.284596414583228, 0.567280187438613},
               1e-8);
    EXPECT_NEAR(fit.logLikelihood, -5.72170081848127, 1e-11);
    EXPECT_NEAR(fit.deviance, 2.29446966764429, 1e-11);
}

TEST(Glm, OffsetEqualsR) {
    BinomialData data = tallies();
    data.design.conservativeResize(Eigen::NoChange, 2);
    data.offset.resize(8);
    data.offset << .1, .2, -.3, .5, 0, 0, 1, -1;
    const GlmFit fit = fitGlm(data);
    expectNear(fit.coefficients, {-0.214933016561752, 1.29359028982344}, 1e-11);
    EXPECT_NEAR(fit.logLikelihood, -6.70909824113384, 1e-11);
}

// sandwich 3.0.2: vcovCL(f, cluster = c(0,0,0,1,1,2,2,2), type = "HC0", cadjust = FALSE)
TEST(Glm, ClusterCovarianceEqualsSandwich) {
    const std::vector<int> cluster{0, 0, 0, 1, 1, 2, 2, 2};
    const GlmFit logit = fitGlm(tallies()), probit = fitGlm(tallies(), {.link = Link::probit});
    expectNear(errors(clusterCovariance(tallies(), logit, Link::logit, cluster)),
               {0.0561637939210678, 0.0972356289129413, 0.27404693094647}, 1e-9);
    expectNear(errors(clusterCovariance(tallies(), probit, Link::probit, cluster)),
               {0.0360022624271096, 0.0578025930862587, 0.179637990235329}, 1e-8);
    EXPECT_THROW(clusterCovariance(tallies(), logit, Link::logit, std::vector<int>{0, 1}), Error);
}

// trials.glm_coef and glm_loglik of golden_values.csv: glm(chose_b ~ condition + pos, binomial),
// and its likelihood-ratio test of the condition.
TEST(Glm, GoldenStudyEqualsR) {
    Study study = trials28x7({1, 2, 3, 4, 5, 6, 7});
    study.data.design.col(0).setOnes();
    const GlmFit fit = fitGlm(study.data);
    expectNear(fit.coefficients,
               {0.443374387737, -0.150318831808, 0.48898702369, -0.443374387737, 1.10668449252,
                -0.736429943667, -0.443374387737, 0.546957782709},
               1e-11);
    EXPECT_NEAR(fit.logLikelihood, -124.07444335, 1e-8);
    const double without = fitGlm(withoutConditions(study).data).logLikelihood;
    const auto test = likelihoodRatio(without, fit.logLikelihood, 6);
    EXPECT_NEAR(test.statistic.value_or(0), 13.864459, 1e-6);
    EXPECT_NEAR(test.p, 0.031187, 1e-6);
}

// pchisq(1300, 3, lower = FALSE); and a larger model is never worse than a smaller.
TEST(Glm, LikelihoodRatioHoldsFarInTheTail) {
    EXPECT_NEAR(likelihoodRatio(-650, 0, 3).p / 1.47174371069801e-281, 1, 1e-10);
    EXPECT_EQ(likelihoodRatio(-5, -5 - 1e-12, 2).p, 1);
}

// A row of k of n is k rows of 1 and n - k of 0: same estimate, another saturated model.
TEST(Glm, TalliesEqualChoices) {
    const BinomialData data = tallies();
    BinomialData single;
    const auto total = static_cast<Eigen::Index>(data.trials.sum());
    single.design.resize(total, 3);
    single.successes.setZero(total);
    single.trials.setOnes(total);
    Eigen::Index row = 0;
    for (Eigen::Index i = 0; i < 8; ++i)
        for (int j = 0; j < data.trials[i]; ++j, ++row) {
            single.design.row(row) = data.design.row(i);
            single.successes[row] = j < data.successes[i] ? 1 : 0;
        }
    const GlmFit whole = fitGlm(data), parts = fitGlm(single);
    EXPECT_LT((whole.coefficients - parts.coefficients).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT((whole.covariance - parts.covariance).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_NEAR(whole.logLikelihood, parts.logLikelihood + logBinomialCoefficients(data), 1e-10);
}

TEST(Glm, SeparatedDataAreDetectedAndFinite) {
    struct Case {
        const char* name;
        std::vector<double> x, chosen;
        bool separated;
        double supremum; // of the log-likelihood
    };
    const double half = std::log(0.5);
    const Case cases[] = {
        {"completely", {1, 2, 3, 4, 5, 6}, {0, 0, 0, 1, 1, 1}, true, 0},
        {"quasi: a tie at the border", {1, 2, 3, 3, 4, 5}, {0, 0, 0, 1, 1, 1}, true, 2 * half},
        {"one cell unanimous", {0, 0, 0, 0, 1, 1}, {0, 1, 0, 1, 1, 1}, true, 4 * half},
        {"all agree", {1, 2, 3, 4, 5, 6}, {1, 1, 1, 1, 1, 1}, true, 0},
        // R: logLik(glm(c(0,0,1,0,1,1) ~ c(1:6), binomial)) = -1.9480169 (finite: 3 and 4 overlap)
        {"overlapping", {1, 2, 3, 4, 5, 6}, {0, 0, 1, 0, 1, 1}, false, 0},
        {"nearly separated", {1, 2, 3.001, 3, 4, 5}, {0, 0, 0, 1, 1, 1}, false, 0},
    };
    for (const Link link : {Link::logit, Link::probit})
        for (const Case& c : cases) {
            const GlmFit fit = fitGlm(choices(c.x, c.chosen), {.link = link});
            EXPECT_EQ(fit.separated, c.separated) << c.name;
            EXPECT_EQ(fit.converged, !c.separated) << c.name;
            EXPECT_TRUE(fit.coefficients.allFinite() && fit.covariance.allFinite()) << c.name;
            EXPECT_TRUE(std::isfinite(fit.logLikelihood) && std::isfinite(fit.deviance)) << c.name;
            if (c.separated) {
                EXPECT_NEAR(fit.logLikelihood, c.supremum, 1e-8) << c.name;
            }
        }
}

// With a prior of variance 1 / q, 0 of n has the posterior mode that solves n F(b) = -q b; here
// checked by that equation itself.
TEST(Glm, PriorMakesUnanimousDataFinite) {
    BinomialData data{MatrixXd::Ones(1, 1), VectorXd::Zero(1), VectorXd::Constant(1, 36)};
    const GlmFit fit = fitGlm(data, {.priorPrecision = MatrixXd::Constant(1, 1, 0.5)});
    EXPECT_TRUE(fit.converged);
    const double b = fit.coefficients[0], share = 1 / (1 + std::exp(-b));
    EXPECT_NEAR(36 * share, -0.5 * b, 1e-10);
    EXPECT_NEAR(fit.covariance(0, 0), 1 / (36 * share * (1 - share) + 0.5), 1e-10);
    EXPECT_NEAR(fit.logLikelihood, 36 * std::log1p(-share), 1e-10);
}

TEST(Glm, PriorOfNoWeightIsNone) {
    const GlmFit plain = fitGlm(tallies());
    const GlmFit weak = fitGlm(tallies(), {.priorPrecision = 1e-12 * MatrixXd::Identity(3, 3)});
    EXPECT_LT((plain.coefficients - weak.coefficients).norm(), 1e-10);
}

TEST(Glm, WrongInputIsNamed) {
    const auto message = [](const BinomialData& data) -> std::string {
        try {
            fitGlm(data);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    BinomialData data = tallies();
    data.design.col(2) = data.design.col(0) * 2;
    EXPECT_NE(message(data).find("depends on the others (rank 2 of 3)"), std::string::npos);
    data = tallies();
    data.successes[3] = 13;
    EXPECT_NE(message(data).find("row 3"), std::string::npos);
    data = tallies();
    data.design(0, 1) = NAN;
    EXPECT_NE(message(data).find("not finite"), std::string::npos);
    data = tallies();
    data.trials.conservativeResize(7);
    EXPECT_NE(message(data).find("found 8, 7 and 0"), std::string::npos);
    data = tallies();
    data.successes.setZero();
    data.trials.setZero();
    EXPECT_NE(message(data).find("at least one trial"), std::string::npos);
}

} // namespace
} // namespace obscura
