#include "tests/inference/simulated_people.h"

#include "inference/binomial_persons.h"
#include "inference/ordinal_rows.h"
#include "inference/random_intercept.h"
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace obscura {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The gradient is that of the approximation with few points too, in every parameter: compared with
// central differences of the value.
void expectExactGradient(ShiftedModel& model, const std::vector<VectorXd>& places) {
    for (const int points : {1, 2, 5, 15}) {
        RandomIntercept likelihood(model, points);
        for (const VectorXd& x : places) {
            VectorXd gradient, unused;
            likelihood(x, gradient);
            for (Index i = 0; i < x.size(); ++i) {
                VectorXd above = x, below = x;
                above[i] += 1e-5;
                below[i] -= 1e-5;
                const double slope = (likelihood(above, unused) - likelihood(below, unused)) / 2e-5;
                EXPECT_NEAR(gradient[i], slope, 1e-6 * (1 + std::abs(slope)))
                    << points << " points, parameter " << i << " at " << x.transpose();
            }
        }
    }
}

TEST(RandomIntercept, GradientIsExact) {
    const Study study = unbalancedPeople();
    const PersonRows rows = groupByPerson(study.data, study.person);
    const std::vector<VectorXd> places = {VectorXd{{0.9, 0.2, 0.8}}, VectorXd{{-0.5, 1.5, 4}},
                                          VectorXd{{0.1, -0.3, -0.05}}, VectorXd{{3, 2, 20}}};
    for (const Link link : {Link::logit, Link::probit})
        expectExactGradient(*binomialModel(rows, link), places);

    OrdinalData ratings{.design = study.data.design.rightCols(1), .category = {}};
    for (Index i = 0; i < study.data.successes.size(); ++i)
        ratings.category.push_back(static_cast<int>(study.data.successes[i] + i % 3));
    for (const Link link : {Link::logit, Link::probit}) {
        OrdinalRows model(ratings, orderByPerson(study.person, ratings.design.rows()), 3, link);
        expectExactGradient(model,
                            {VectorXd{{-1, 0.1, 0.9, 0.4, 0.8}}, VectorXd{{-0.4, 0.3, 2, -1, 3}}});
    }
}

// The logit's own code (products of exponentials) and the general one are the same function.
TEST(RandomIntercept, FastLogitIsTheLogit) {
    Study study = unbalancedPeople();
    study.data.trials[3] = 4;
    study.data.successes[3] = 3;
    const PersonRows rows = groupByPerson(study.data, study.person);
    const auto fast = binomialModel(rows, Link::logit);
    BinomialPersons general(rows, Link::logit);
    for (const VectorXd& x : {VectorXd{{0.9, 0.2, 0.8}}, VectorXd{{-5, 3, 25}}}) {
        RandomIntercept a(*fast, 15), b(general, 15);
        VectorXd byA, byB;
        EXPECT_NEAR(a(x, byA), b(x, byB), 1e-10);
        EXPECT_LT((byA - byB).cwiseAbs().maxCoeff(), 1e-8);
    }
}

} // namespace
} // namespace obscura
