#include "base/error.h"

#include "inference/optimise.h"
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Moments of the standard normal: 1, 0, 1, 0, 3, 0, 15 ... exact below degree 2 n.
TEST(GaussHermite, GivesTheMomentsOfTheNormal) {
    for (const int n : {1, 2, 5, 15, 40, 100}) {
        const Quadrature rule = gaussHermite(n);
        double moment = 1;
        for (int degree = 0; degree < 2 * n && degree <= 16; degree += 2) {
            EXPECT_NEAR((rule.weights * rule.nodes.pow(degree)).sum() / moment, 1, 1e-12)
                << n << ' ' << degree;
            EXPECT_NEAR((rule.weights * rule.nodes.pow(degree + 1)).sum() / moment, 0, 1e-10);
            moment *= degree + 1;
        }
    }
    // Abramowitz and Stegun 25.10, n = 3: sqrt(3), weights 1/6 and 2/3.
    const Quadrature three = gaussHermite(3);
    EXPECT_NEAR(three.nodes[2], std::sqrt(3), 1e-14);
    EXPECT_NEAR(three.weights[0], 1.0 / 6, 1e-14);
    EXPECT_EQ(three.nodes[1], 0);
    EXPECT_THROW(gaussHermite(0), Error);
}

// Rosenbrock's valley, the other way up: one maximum, at (1, 1), along a bend.
TEST(Maximise, FollowsABentRidge) {
    const Objective valley = [](const VectorXd& x, VectorXd& gradient) {
        const double along = 1 - x[0], across = x[1] - x[0] * x[0];
        gradient = VectorXd{{2 * along + 400 * x[0] * across, -200 * across}};
        return -along * along - 100 * across * across;
    };
    const Maximum found = maximise(valley, VectorXd{{-1.2, 1}}, MatrixXd::Identity(2, 2));
    EXPECT_TRUE(found.reached);
    EXPECT_LT((found.at - VectorXd::Ones(2)).norm(), 1e-8);
    // The second derivative there is minus ((802, -400), (-400, 200)).
    EXPECT_NEAR(found.covariance(0, 0), 0.5, 1e-4);
    EXPECT_NEAR(found.covariance(1, 1), 802.0 / 400, 1e-3);
}

TEST(Maximise, SaysWhenThereIsNone) {
    const Objective rising = [](const VectorXd& x, VectorXd& gradient) {
        gradient = VectorXd{{std::exp(-x[0]), -2 * x[1]}};
        return -std::exp(-x[0]) - x[1] * x[1];
    };
    const Maximum found = maximise(rising, VectorXd{{0, 1}}, MatrixXd::Identity(2, 2));
    EXPECT_FALSE(found.reached);
    EXPECT_NEAR(found.value, 0, 1e-6);
    EXPECT_TRUE(found.at.allFinite() && found.covariance.allFinite());
    const Objective saddle = [](const VectorXd& x, VectorXd& gradient) {
        gradient = VectorXd{{-2 * x[0], 2 * x[1]}};
        return x[1] * x[1] - x[0] * x[0];
    };
    EXPECT_FALSE(maximise(saddle, VectorXd{{0, 0}}, MatrixXd::Identity(2, 2)).reached);
}

} // namespace
} // namespace obscura
