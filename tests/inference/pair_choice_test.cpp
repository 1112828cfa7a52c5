// Truth: variances integrated in two dimensions, a posterior by brute force, batches by hand, and
// people of known scales.
#include "base/random.h"

#include "inference/pair_choice.h"
#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

double phi(double x) { return std::erfc(-x / std::sqrt(2.0)) / 2; }

// The variances of both values after either answer, integrated over a plane.
TEST(PairChoice, TheReductionIsThatOfTheExpectedVariances) {
    PairPosterior posterior{Eigen::Vector2d(0.8, -0.5), Eigen::Matrix2d{{1.5, 0.6}, {0.6, 0.9}}};
    const Eigen::Matrix2d precision = posterior.covariance.inverse();
    constexpr double step = 0.05;
    double after = 0, total = 0;
    for (const bool wins : {true, false}) {
        double mass = 0;
        Eigen::Vector2d sum = Eigen::Vector2d::Zero(), squares = sum;
        for (double x = -10; x <= 10; x += step)
            for (double y = -10; y <= 10; y += step) {
                const Eigen::Vector2d at(x, y), off = at - posterior.mean;
                const double weight = std::exp(-off.dot(precision * off) / 2) *
                                      phi((wins ? 1 : -1) * (x - y) * jodUnit);
                mass += weight;
                sum += weight * at;
                squares += weight * at.cwiseAbs2();
            }
        after += squares.sum() - sum.squaredNorm() / mass;
        total += mass;
    }
    const double reduction = posterior.covariance.trace() - after / total;
    EXPECT_NEAR(expectedReduction(posterior, 0, 1), reduction, 1e-9);
    EXPECT_NEAR(expectedReduction(posterior, 1, 0), reduction, 1e-9);
}

TEST(PairChoice, WhatIsCertainNarrowsNothing) {
    PairPosterior posterior{Eigen::Vector3d(0, 0, 20), Eigen::Matrix3d::Identity()};
    EXPECT_LT(expectedReduction(posterior, 0, 2), 1e-6);
    EXPECT_GT(expectedReduction(posterior, 0, 1), 0.1);
    posterior.mean(2) = 1e6; // beyond where F is 1 in double precision
    EXPECT_EQ(expectedReduction(posterior, 0, 2), 0);
    posterior.covariance *= 1e-10; // only the answer is uncertain, and known to be
    EXPECT_LT(expectedReduction(posterior, 0, 1), 1e-9);
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

// Of four items of which nothing is known, two pairs apart say more than two that share an item,
// and then a pair that joins them; one far off waits until the near ones are narrower.
TEST(PairChoice, EachPairOfABatchCountsOnThoseBefore) {
    const std::vector<ItemPair> pairs = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    const PairPosterior alike{Eigen::Vector4d::Zero(), Eigen::Matrix4d::Identity()};
    EXPECT_THAT(nextBatch(alike, pairs), ElementsAre(0, 5, 1));
    const PairPosterior far{Eigen::Vector4d(0, 1, 3, 9), Eigen::Matrix4d::Identity() * 0.5};
    EXPECT_THAT(nextBatch(far, pairs), UnorderedElementsAre(0, 1, 3));
    const std::vector<ItemPair> apart = {{0, 1}, {2, 3}};
    EXPECT_THAT(nextBatch(far, apart), ElementsAre(0, 1));
}

// Independent values of variance 1: each lies from the mean of its scale's n items with variance
// 1 - 1 / n.
TEST(PairChoice, IntervalsAreWithinAScale) {
    const PairPosterior posterior = pairPosterior(Wins::Zero(5, 5), 1);
    const std::vector<ItemPair> two = {{0, 1}, {2, 3}}, one = {{0, 1}, {1, 2}, {3, 4}, {2, 3}};
    EXPECT_NEAR(widestInterval(posterior, two), 2 * 1.959963985 * std::sqrt(1 / 2.0), 1e-8);
    EXPECT_NEAR(widestInterval(posterior, one), 2 * 1.959963985 * std::sqrt(4 / 5.0), 1e-8);
}

// People of case V compare items whose true values lie anywhere within `range` JOD.
class Study {
  public:
    Study(int items, double range, double priorSd, int repetition)
        : random_(20200405, "study " + std::to_string(repetition)), truth_(items),
          wins_(Wins::Zero(items, items)), sd_(priorSd) {
        for (double& value : truth_)
            value = range * random_.uniform();
        truth_.array() -= truth_.mean();
        for (int i = 0; i < items; ++i)
            for (int j = 0; j < i; ++j)
                pairs_.emplace_back(i, j);
    }
    void compareAll(int people) {
        for (int person = 0; person < people; ++person)
            for (const ItemPair& pair : pairs_)
                compare(pair);
    }
    void compareBatch() {
        random_.shuffle(pairs_);
        for (const int index : nextBatch(pairPosterior(wins_, sd_), pairs_))
            compare(pairs_[static_cast<std::size_t>(index)]);
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

// Mean squared errors in JOD^2. The full design shows every pair to each of 15 people.
struct Accuracy {
    double full = 0, twoFifths = 0; // of all people, and of two fifths of them
    std::vector<double> chosen;     // after each batch

    // The share of trials from which on chosen ones are as good as the full design; above 1, never.
    double share(int batches) const {
        const auto first =
            std::find_if(chosen.begin(), chosen.end(), [&](double error) { return error <= full; });
        return static_cast<double>(first - chosen.begin() + 1) / batches;
    }
};
Accuracy accuracy(int items, double range, double priorSd, int studies, int batches) {
    Accuracy mean{.chosen = std::vector<double>(static_cast<std::size_t>(batches))};
    for (int study = 0; study < studies; ++study) {
        Study all(items, range, priorSd, study), some(items, range, priorSd, study);
        all.compareAll(6);
        mean.twoFifths += all.squaredError() / studies;
        all.compareAll(9);
        mean.full += all.squaredError() / studies;
        for (double& error : mean.chosen) {
            some.compareBatch();
            error += some.squaredError() / studies;
        }
    }
    return mean;
}

// The table of docs/measurement.md: how many of the full design's trials are enough.
void printShares(int studies) {
    for (const bool isMatched : {false, true})
        for (const int items : {8, 12, 16})
            for (const double range : {5., 10., 15., 20.}) {
                const double priorSd = isMatched ? range / std::sqrt(12.0) : pairPriorSd;
                const int batches = 15 * items / 2;
                const Accuracy found = accuracy(items, range, priorSd, studies, batches);
                const auto at40 = static_cast<std::size_t>(batches * 2 / 5 - 1);
                std::printf("prior %.2f, %2d items over %2.0f JOD: equal at %.2f; RMSE %.3f JOD of "
                            "the full design; of 40 %% of its trials %.3f chosen, %.3f not\n",
                            priorSd, items, range, found.share(batches), std::sqrt(found.full),
                            std::sqrt(found.chosen[at40]), std::sqrt(found.twoFifths));
            }
}

// Wide scales, where there is most to save, with the prior of the presenter. OBSCURA_STUDIES=100
// prints how it is elsewhere.
TEST(PairChoice, TwoFifthsOfTheTrialsOfAWideScaleAreAsGoodAsAll) {
    for (const auto& [items, range] : {std::pair(16, 15), {12, 20}, {16, 20}}) {
        const int batches = 15 * items / 2 * 2 / 5;
        const Accuracy found = accuracy(items, range, pairPriorSd, 10, batches);
        EXPECT_LE(std::sqrt(found.chosen.back()), 1.1 * std::sqrt(found.full)) << items << range;
        EXPECT_LT(found.chosen.back(), found.twoFifths) << items << range;
    }
    if (const char* studies = std::getenv("OBSCURA_STUDIES"))
        printShares(std::atoi(studies));
}

} // namespace
} // namespace obscura
