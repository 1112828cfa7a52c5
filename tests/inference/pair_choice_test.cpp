// Truth: divergences integrated in two dimensions, a posterior by brute force, trees counted by
// hand, and people of known scales.
#include "base/random.h"

#include "inference/pair_choice.h"
#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
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

// People of case V compare items whose true values lie anywhere within `range` JOD; the prior is as
// wide as that.
class Study {
  public:
    Study(int items, double range, int repetition)
        : random_(20200405, "study " + std::to_string(repetition)), truth_(items),
          wins_(Wins::Zero(items, items)), sd_(range / std::sqrt(12.0)) {
        for (double& value : truth_)
            value = range * random_.uniform();
        truth_.array() -= truth_.mean();
        for (int i = 0; i < items; ++i)
            for (int j = 0; j < i; ++j)
                pairs_.emplace_back(i, j);
    }
    // Every pair, by so many people; gives the number of trials.
    int compareAll(int people) {
        for (int person = 0; person < people; ++person)
            for (const ItemPair& pair : pairs_)
                compare(pair);
        return people * static_cast<int>(pairs_.size());
    }
    void compareBatches(double trials) {
        std::vector<ItemPair> order = pairs_;
        const auto size = static_cast<double>(truth_.size() - 1);
        for (double shown = size; shown <= trials; shown += size) {
            random_.shuffle(order);
            for (const int index : nextBatch(pairPosterior(wins_, sd_), order))
                compare(order[static_cast<std::size_t>(index)]);
        }
    }
    double squaredError() const {
        const Eigen::VectorXd mean = pairPosterior(wins_, sd_).mean;
        return (mean.array() - mean.mean() - truth_.array()).square().mean();
    }

  private:
    void compare(const ItemPair& pair) {
        const auto& [i, j] = pair;
        const bool first = random_.uniform() < phi((truth_(i) - truth_(j)) * jodUnit);
        (first ? wins_(i, j) : wins_(j, i)) += 1;
    }

    Random random_;
    Eigen::VectorXd truth_;
    Wins wins_;
    double sd_;
    std::vector<ItemPair> pairs_;
};

// The full design shows every pair to each of 15 people. OBSCURA_STUDIES=100 for the figures of
// docs/measurement.md. Narrower scales gain less: over 10 JOD no design, even of one who knew the
// truth, could do with less than about half of the trials.
TEST(PairChoice, TwoFifthsOfTheTrialsAreAsGoodAsTheFullDesign) {
    const char* asked = std::getenv("OBSCURA_STUDIES");
    const int studies = asked ? std::atoi(asked) : 10;
    const std::vector<double> ranges = asked ? std::vector{5., 10., 15., 20.} : std::vector{20.};
    for (const int items : {8, 12, 16})
        for (const double range : ranges) {
            double full = 0, chosen = 0, fewer = 0;
            for (int study = 0; study < studies; ++study) {
                Study all(items, range, study), some(items, range, study),
                    thinned(items, range, study);
                const int trials = all.compareAll(15);
                some.compareBatches(0.4 * trials);
                thinned.compareAll(6);
                full += all.squaredError() / studies;
                chosen += some.squaredError() / studies;
                fewer += thinned.squaredError() / studies;
            }
            std::printf(
                "%2d items over %2.0f JOD: RMSE %.3f JOD of the full design; of 40 %% of its "
                "trials %.3f chosen, %.3f not\n",
                items, range, std::sqrt(full), std::sqrt(chosen), std::sqrt(fewer));
            if (range == 20) {
                EXPECT_LE(std::sqrt(chosen), std::sqrt(full) * (studies >= 100 ? 1.03 : 1.1));
                EXPECT_LT(chosen, fewer);
            }
        }
}

} // namespace
} // namespace obscura
