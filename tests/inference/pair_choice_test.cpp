// Truth: divergences integrated in two dimensions, a posterior by brute force, trees counted by
// hand, and people of known scales.
#include "base/random.h"

#include "inference/pair_choice.h"
#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

double phi(double x) { return std::erfc(-x / std::sqrt(2.0)) / 2; }

// The mean of KL(after | before) over both answers, both values integrated over a plane.
TEST(PairChoice, TheGainIsTheExpectedDivergence) {
    PairPosterior posterior{Eigen::Vector2d(0.8, -0.5), Eigen::Matrix2d{{1.5, 0.6}, {0.6, 0.9}}};
    const Eigen::Matrix2d precision = posterior.covariance.inverse();
    constexpr double step = 0.05;
    double gain = 0;
    for (const bool wins : {true, false}) {
        double mass = 0, likely = 0, logs = 0;
        for (double x = -8; x <= 8; x += step)
            for (double y = -8; y <= 8; y += step) {
                const Eigen::Vector2d off = Eigen::Vector2d(x, y) - posterior.mean;
                const double before = std::exp(-off.dot(precision * off) / 2);
                const double p = phi((wins ? 1 : -1) * (x - y) * jodUnit);
                mass += before;
                likely += before * p;
                logs += before * p * std::log(std::max(p, 1e-300));
            }
        gain += (logs - likely * std::log(likely / mass)) / mass;
    }
    EXPECT_NEAR(expectedGain(posterior, 0, 1), gain, 1e-9);
    EXPECT_NEAR(expectedGain(posterior, 1, 0), gain, 1e-9);
}

TEST(PairChoice, WhatIsCertainSaysNothing) {
    PairPosterior posterior{Eigen::Vector3d(0, 0, 20), Eigen::Matrix3d::Identity()};
    EXPECT_LT(expectedGain(posterior, 0, 2), 1e-6);
    EXPECT_GT(expectedGain(posterior, 0, 1), 0.1);
    posterior.covariance *= 1e-10; // only the answer is uncertain, and known to be
    EXPECT_LT(expectedGain(posterior, 0, 1), 1e-9);
}

TEST(PairChoice, ThePosteriorOfNothingIsThePrior) {
    const PairPosterior posterior = pairPosterior(Wins::Zero(3, 3), 2);
    EXPECT_EQ(posterior.mean, Eigen::Vector3d::Zero());
    EXPECT_EQ(posterior.covariance, Eigen::Matrix3d::Identity() * 4);
}

// Where thurstone() has a scale, the posterior is that scale but for its level.
TEST(PairChoice, ThePosteriorIsThurstonesScale) {
    const Wins wins{{0, 3, 1}, {2, 0, 4}, {0, 1, 0}};
    const PairPosterior posterior = pairPosterior(wins);
    const Scale scale = thurstone(wins, 3).value();
    EXPECT_TRUE((posterior.mean.array() - posterior.mean.mean())
                    .matrix()
                    .isApprox(Eigen::VectorXd(scale.values.array()), 1e-6));
}

// One win is enough for all the rest to be finite: the mode solves x = u f(2xu) / F(2xu) sd^2.
TEST(PairChoice, ItemsNeverComparedKeepThePrior) {
    Wins wins = Wins::Zero(3, 3);
    wins(0, 1) = 1;
    const PairPosterior posterior = pairPosterior(wins, 1);
    const double x = posterior.mean(0), z = 2 * x * jodUnit;
    EXPECT_NEAR(x, jodUnit * std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi) / phi(z), 1e-8);
    EXPECT_NEAR(posterior.mean(1), -x, 1e-9);
    EXPECT_NEAR(posterior.mean(2), 0, 1e-12);
    EXPECT_NEAR(posterior.covariance(2, 2), 1, 1e-12);
}

// Items 0, 1 and 2 near one another, 3 far away: the tree has the near pairs and the nearest way
// to the far one.
TEST(PairChoice, ABatchIsTheSpanningTreeOfTheGreatestGains) {
    const PairPosterior posterior{Eigen::Vector4d(0, 1, 3, 9), Eigen::Matrix4d::Identity() * 0.5};
    const std::vector<ItemPair> pairs = {{0, 3}, {1, 3}, {2, 3}, {0, 2}, {1, 2}, {0, 1}};
    EXPECT_THAT(nextBatch(posterior, pairs), ElementsAre(5, 4, 2));
    const std::vector<ItemPair> apart = {{0, 1}, {2, 3}};
    EXPECT_THAT(nextBatch(posterior, apart), UnorderedElementsAre(0, 1));
}

// Independent values of variance 1: each lies from the mean of its scale's n items with variance
// 1 - 1 / n.
TEST(PairChoice, IntervalsAreWithinAScale) {
    const PairPosterior posterior = pairPosterior(Wins::Zero(5, 5), 1);
    const std::vector<ItemPair> two = {{0, 1}, {2, 3}}, one = {{0, 1}, {1, 2}, {3, 4}, {2, 3}};
    EXPECT_NEAR(widestInterval(posterior, two), 2 * 1.959963985 * std::sqrt(1 / 2.0), 1e-8);
    EXPECT_NEAR(widestInterval(posterior, one), 2 * 1.959963985 * std::sqrt(4 / 5.0), 1e-8);
}

// People of case V compare items whose true values are evenly spread over `range` JOD.
class Study {
  public:
    Study(int items, double range, int repetition)
        : items_(items), random_(20200405, "study " + std::to_string(repetition)), truth_(items),
          wins_(Wins::Zero(items, items)) {
        for (double& value : truth_)
            value = range * random_.uniform();
        truth_.array() -= truth_.mean();
        for (int i = 0; i < items; ++i)
            for (int j = 0; j < i; ++j)
                pairs_.emplace_back(i, j);
    }
    int full() const { return static_cast<int>(pairs_.size()); }
    void compareAll() {
        for (const ItemPair& pair : pairs_)
            compare(pair);
    }
    int compareBatch() {
        std::vector<ItemPair> order = pairs_;
        random_.shuffle(order);
        const std::vector<int> batch = nextBatch(pairPosterior(wins_), order);
        for (const int index : batch)
            compare(order[static_cast<std::size_t>(index)]);
        return static_cast<int>(batch.size());
    }
    double squaredError() const {
        const Eigen::VectorXd mean = pairPosterior(wins_).mean;
        return (mean.array() - mean.mean() - truth_.array()).square().mean();
    }

  private:
    void compare(const ItemPair& pair) {
        const auto& [i, j] = pair;
        const bool first = random_.uniform() < phi((truth_(i) - truth_(j)) * jodUnit);
        (first ? wins_(i, j) : wins_(j, i)) += 1;
    }

    int items_;
    Random random_;
    Eigen::VectorXd truth_;
    Wins wins_;
    std::vector<ItemPair> pairs_;
};

// The full design shows every pair to each of 15 people. OBSCURA_OBSERVERS=100 (repetitions) for
// the figures of docs/measurement.md.
TEST(PairChoice, TwoFifthsOfTheTrialsAreAsGoodAsTheFullDesign) {
    const char* asked = std::getenv("OBSCURA_OBSERVERS");
    const int repetitions = asked ? std::min(std::atoi(asked), 200) : 12, people = 15;
    for (const int items : {8, 12, 16})
        for (const double range : {5.0, 10.0, 15.0}) {
            double full = 0, active = 0, random = 0;
            for (int repetition = 0; repetition < repetitions; ++repetition) {
                Study all(items, range, repetition), chosen(items, range, repetition);
                for (int person = 0; person < people; ++person)
                    all.compareAll();
                int trials = 0;
                while (trials + items - 1 <= 0.4 * people * all.full())
                    trials += chosen.compareBatch();
                Study fewer(items, range, repetition);
                for (int person = 0; person < people * 2 / 5; ++person)
                    fewer.compareAll();
                full += all.squaredError() / repetitions;
                active += chosen.squaredError() / repetitions;
                random += fewer.squaredError() / repetitions;
            }
            std::printf("%2d items over %2.0f JOD: RMSE %.3f of the full design, %.3f of 40 %% "
                        "chosen, %.3f of 40 %% in full passes\n",
                        items, range, std::sqrt(full), std::sqrt(active), std::sqrt(random));
        }
}

} // namespace
} // namespace obscura
