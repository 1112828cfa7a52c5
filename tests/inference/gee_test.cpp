#include "base/error.h"
#include "tests/inference/simulated_people.h"
#include "tests/inference/trials_28x7.h"

#include "inference/gee.h"
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace obscura {
namespace {

using Eigen::Index;

// geepack 1.3.9: geeglm(chose_b ~ 0 + condition + pos, id = factor(participant_id), binomial,
// corstr = "exchangeable", control = geese.control(epsilon = 1e-12))
TEST(Gee, GoldenStudyEqualsGeepack) {
    const Study study = trials28x7({1, 2, 3, 4, 5, 6, 7});
    const GeeFit fit = fitGee(study.data, study.person);
    EXPECT_TRUE(fit.converged);
    EXPECT_NEAR(fit.coefficients[5], -0.292821087848368, 1e-10);
    EXPECT_NEAR(fit.coefficients[6], 0.001208943995567, 1e-10);
    EXPECT_NEAR(fit.coefficients[7], 0.555390376585362, 1e-10);
    EXPECT_NEAR(std::sqrt(fit.covariance(5, 5)), 0.3675498663093, 1e-9);
    EXPECT_NEAR(std::sqrt(fit.covariance(7, 7)), 0.2818260949526, 1e-9);
    EXPECT_NEAR(fit.correlation, 0.03859863873921, 1e-10);
    EXPECT_NEAR(fit.scale, 1.001251907969, 1e-10);
}

TEST(Gee, UnbalancedStudyEqualsGeepack) {
    const Study study = unbalancedPeople();
    GeeFit fit = fitGee(study.data, study.person);
    EXPECT_NEAR(fit.coefficients[0], 0.8735198355467, 1e-10);
    EXPECT_NEAR(fit.coefficients[1], 0.1348846073725, 1e-10);
    EXPECT_NEAR(std::sqrt(fit.covariance(0, 0)), 0.2683472455178, 1e-9);
    EXPECT_NEAR(std::sqrt(fit.covariance(1, 1)), 0.1817867047256, 1e-9);
    EXPECT_NEAR(fit.correlation, 0.1085312357399, 1e-10);
    EXPECT_NEAR(fit.scale, 0.9825308447528, 1e-10);
    fit = fitGee(study.data, study.person, Link::probit);
    EXPECT_NEAR(fit.coefficients[0], 0.53975698799103, 1e-10);
    EXPECT_NEAR(fit.coefficients[1], 0.08237939664619, 1e-10);
    EXPECT_NEAR(std::sqrt(fit.covariance(0, 0)), 0.1619310351383, 1e-9);
    EXPECT_NEAR(std::sqrt(fit.covariance(1, 1)), 0.1099588425631, 1e-9);
    EXPECT_NEAR(fit.correlation, 0.1086590014495, 1e-10);
}

// Mancl and DeRouen's formula by its matrices, in R 4.2.2 from the fits of geepack above, alpha
// their correlation; with alpha = 0 and glm's fit it is clubSandwich 0.5.8's CR3 (to 4e-7).
//   parts <- lapply(split(seq_along(y), id), function(r) {
//     A <- mu[r] * (1 - mu[r]); n <- length(r)
//     R <- matrix(alpha, n, n); diag(R) <- 1
//     list(D = X[r, , drop = FALSE] * A, e = (y - mu)[r],
//          W = solve(diag(sqrt(A), n) %*% R %*% diag(sqrt(A), n))) })
//   M <- solve(Reduce(`+`, lapply(parts, function(p) t(p$D) %*% p$W %*% p$D)))
//   B <- Reduce(`+`, lapply(parts, function(p) {
//     H <- p$D %*% M %*% t(p$D) %*% p$W
//     s <- t(p$D) %*% p$W %*% solve(diag(nrow(H)) - H, p$e); s %*% t(s) }))
//   M %*% B %*% M
TEST(Gee, CorrectedCovarianceIsManclAndDeRouens) {
    const Study study = trials28x7({1, 2, 3, 4, 5, 6, 7});
    GeeFit fit = fitGee(study.data, study.person);
    ASSERT_TRUE(fit.corrected);
    EXPECT_NEAR(std::sqrt((*fit.corrected)(0, 0)), 0.4271405115407, 1e-9);
    EXPECT_NEAR(std::sqrt((*fit.corrected)(5, 5)), 0.3820027111135, 1e-9);
    EXPECT_NEAR(std::sqrt((*fit.corrected)(7, 7)), 0.3035296120119, 1e-9);
    const Study unbalanced = unbalancedPeople();
    fit = fitGee(unbalanced.data, unbalanced.person);
    ASSERT_TRUE(fit.corrected);
    EXPECT_NEAR((*fit.corrected)(0, 0), 0.08214869061072, 1e-9);
    EXPECT_NEAR((*fit.corrected)(0, 1), -0.01114234774214, 1e-9);
    EXPECT_NEAR((*fit.corrected)(1, 1), 0.03826447603763, 1e-9);
}

// Without the person whom a coefficient rests on there is none.
TEST(Gee, ACoefficientOfOnePersonHasNoCorrectedCovariance) {
    Study study = unbalancedPeople();
    for (Index i = 0; i < study.data.design.rows(); ++i) {
        study.data.design(i, 1) = study.person[static_cast<std::size_t>(i)] == 5;
        study.data.successes(i) = static_cast<double>(i % 2);
    }
    const GeeFit fit = fitGee(study.data, study.person);
    EXPECT_FALSE(fit.separated);
    EXPECT_FALSE(fit.corrected);
}

// With one answer each there is nothing to correlate: the logistic fit, its robust covariance.
TEST(Gee, OneAnswerEachIsTheLogisticFit) {
    const Study study = unbalancedPeople();
    std::vector<int> each;
    for (int i = 0; i < static_cast<int>(study.person.size()); ++i)
        each.push_back(i);
    const GeeFit fit = fitGee(study.data, each);
    const GlmFit plain = fitGlm(study.data);
    EXPECT_EQ(fit.correlation, 0);
    EXPECT_LT((fit.coefficients - plain.coefficients).norm(), 1e-9);
    EXPECT_LT((fit.covariance - clusterCovariance(study.data, plain, Link::logit, each)).norm(),
              1e-9);
}

TEST(Gee, RowsMayComeInAnyOrder) {
    const Study study = unbalancedPeople();
    Study reversed = study;
    reversed.data.design = study.data.design.colwise().reverse();
    reversed.data.successes = study.data.successes.reverse();
    reversed.person.assign(study.person.rbegin(), study.person.rend());
    const GeeFit a = fitGee(study.data, study.person), b = fitGee(reversed.data, reversed.person);
    EXPECT_LT((a.coefficients - b.coefficients).norm(), 1e-12);
    EXPECT_LT((a.covariance - b.covariance).norm(), 1e-12);
}

TEST(Gee, SeparatedDataAreSaidAndFinite) {
    Study study = unbalancedPeople();
    study.data.successes = (study.data.design.col(1).array() > 0.55).cast<double>();
    GeeFit fit = fitGee(study.data, study.person);
    EXPECT_TRUE(fit.separated);
    EXPECT_FALSE(fit.converged);
    EXPECT_TRUE(fit.coefficients.allFinite() && fit.covariance.allFinite());
    // Nobody disagrees with themselves: the correlation goes to its bound.
    for (std::size_t i = 0; i < study.person.size(); ++i)
        study.data.successes[static_cast<Index>(i)] = study.person[i] % 2;
    fit = fitGee(study.data, study.person);
    EXPECT_TRUE(fit.coefficients.allFinite() && fit.covariance.allFinite());
    if (fit.converged)
        EXPECT_GT(fit.correlation, 0.9);
    else
        EXPECT_LT((fit.coefficients - fitGlm(study.data).coefficients).norm(), 1e-12);
}

// Found by trying thousands: here the iteration leaves for shares of 0 and 1.
TEST(Gee, WhatDivergesIsSaidAndFallsBack) {
    const std::vector<double> x{1, 0,  -1, -1, 3, -4, -1, 3, -1, -1,
                                0, -3, -1, -4, 1, 1,  0,  1, 2,  1};
    const std::vector<double> y{0, 1, 1, 1, 0, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0};
    const std::vector<int> person{0, 0, 0, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 3, 3, 3, 4, 4, 4, 4};
    BinomialData data{Eigen::MatrixXd::Ones(20, 2), Eigen::VectorXd::Map(y.data(), 20),
                      Eigen::VectorXd::Ones(20)};
    data.design.col(1) = Eigen::VectorXd::Map(x.data(), 20);
    for (const Link link : {Link::logit, Link::probit}) {
        const GeeFit fit = fitGee(data, person, link);
        EXPECT_TRUE(fit.coefficients.allFinite() && fit.covariance.allFinite());
        EXPECT_LT(fit.coefficients.cwiseAbs().maxCoeff(), 5);
    }
}

TEST(Gee, WrongInputIsNamed) {
    Study study = unbalancedPeople();
    EXPECT_THROW(fitGee(study.data, std::vector<int>(study.person.size(), 0)), Error);
    study.data.trials[4] = 2;
    EXPECT_THROW(fitGee(study.data, study.person), Error);
}

} // namespace
} // namespace obscura
