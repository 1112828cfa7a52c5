// Truth: the runs that Watson (2017) prints, as hoechenberger/questplus 2019.4 (Python) has them
// among its tests; and the definition of expected entropy, worked out without its shortcut.
#include "base/error.h"
#include "base/random.h"

#include "inference/psychometric.h"
#include "inference/quest_plus.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

namespace obscura {
namespace {

std::vector<double> amplitudes() { // -40 ... 0 dB
    std::vector<double> levels;
    for (int dB = -40; dB <= 0; ++dB)
        levels.push_back(std::pow(10, dB / 20.0));
    return levels;
}

QuestGrid watsonGrid(std::vector<double> slopes, std::vector<double> lapses) {
    return {Sigmoid::weibull,  amplitudes(), amplitudes(),
            std::move(slopes), {0.5},        std::move(lapses)};
}

struct WatsonRun {
    const char* name;
    QuestGrid grid;
    std::vector<int> shown; // dB
    std::string answers;    // right, or x for wrong
    double threshold, slope, lapse;
};
void PrintTo(const WatsonRun& run, std::ostream* out) { *out << run.name; }

const WatsonRun runs[] = {
    {"Threshold",
     watsonGrid({3.5}, {0.02}),
     {-18, -22, -25, -28, -30, -22, -13, -15, -16, -18, -19, -20, -21, -22, -23, -19,
      -20, -20, -18, -18, -19, -17, -17, -18, -18, -18, -19, -19, -19, -19, -19, -19},
     "....xx........x..x..x...........",
     -20,
     3.5,
     0.02},
    {"ThresholdAndSlope",
     watsonGrid({2, 3, 4, 5}, {0.02}),
     {-18, -22, -12, -13, -15, -16, -17, -18, -19, -21, -24, -25, -26, -27, -21, -22,
      -23, -20, -20, -20, -21, -19, -19, -20, -20, -20, -19, -19, -19, -19, -19, -20,
      -20, -20, -20, -20, -21, -21, -20, -20, -20, -19, -18, -18, -19, -19, -19, -18,
      -18, -17, -18, -18, -18, -17, -17, -17, -17, -17, -17, -17, -18, -18, -18, -18},
     ".x...........x..x...x....x...........x..xx....x.x...x...........",
     -20,
     3,
     0.02},
    {"ThresholdSlopeAndLapse",
     watsonGrid({2, 3, 4, 5}, {0, 0.01, 0.02, 0.03, 0.04}),
     {-18, -22, -25, -28, -30, -21, -12, -14, -15, -16, -18, -19, -20, -22, -23, -18, -19, -16, -17,
      -17, -18, -18, -18, -19, -19, -17, -17, -18, -18, -18, -18, -19, -19, -20, -18, -18, -18, -18,
      -18, -19, -19, -19, -19, -20, -18, -18, -18, -18, -18, -18, -18, -18, -18, -19, -19, -19, -20,
      -18, -18, -18, -18, -19, -19, -19, -18, -18, -18, -18, -19, -19, -19, -19, -19, -19, -19, -19,
      -20, -21, -19, -19, -19, -19, -19, -19, -19, -18, -19, -19, -16, -16, -16, -16, -16, -16, 0,
      0,   -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -21, -21, -19, -19,
      -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19, -19},
     "....xx........x.x.......x........x.........x...x........x......x.............x.x....x..x....."
     "..x...............x...x.xx....x....",
     -20,
     5,
     0.04},
};

class PublishedRun : public testing::TestWithParam<WatsonRun> {};

TEST_P(PublishedRun, ShowsTheSameLevels) {
    const WatsonRun& run = GetParam();
    QuestPlus quest(run.grid);
    ASSERT_EQ(run.shown.size(), run.answers.size());
    for (std::size_t i = 0; i < run.shown.size(); ++i) {
        const int level = quest.next();
        ASSERT_EQ(level - 40, run.shown[i]) << "trial " << i + 1;
        quest.answer(level, run.answers[i] == '.');
    }
    EXPECT_NEAR(20 * std::log10(quest.mode(QuestParameter::threshold)), run.threshold, 1e-9);
    EXPECT_EQ(quest.mode(QuestParameter::slope), run.slope);
    EXPECT_EQ(quest.mode(QuestParameter::lapse), run.lapse);
}

INSTANTIATE_TEST_SUITE_P(Watson, PublishedRun, testing::ValuesIn(runs),
                         [](const auto& run) { return std::string(run.param.name); });

// For both answers, the posterior by Bayes' rule and its entropy; their mean, weighted by how
// likely the answers are.
TEST(QuestPlus, ExpectsTheEntropyThatComes) {
    const QuestGrid grid{Sigmoid::normal, {-1, 0, 0.5, 2}, {-1, 0, 1},
                         {0.5, 2},        {0.2, 0.5},      {0, 0.1}};
    QuestPlus quest(grid);
    const std::vector<std::pair<int, bool>> answers = {{1, true}, {3, false}, {0, true}};
    for (const auto& [level, success] : answers)
        quest.answer(level, success);
    for (int shown = 0; shown < 4; ++shown) {
        double expected = 0;
        for (const bool outcome : {false, true}) {
            std::vector<double> before, after;
            for (const double threshold : grid.thresholds)
                for (const double slope : grid.slopes)
                    for (const double guess : grid.guesses)
                        for (const double lapse : grid.lapses) {
                            const auto chance = [&](int level, bool success) {
                                const double z =
                                    slope *
                                    (grid.levels[static_cast<std::size_t>(level)] - threshold);
                                const double p = guess + (1 - guess - lapse) *
                                                             std::erfc(-z / std::sqrt(2.0)) / 2;
                                return success ? p : 1 - p;
                            };
                            double product = 1;
                            for (const auto& answer : answers)
                                product *= chance(answer.first, answer.second);
                            before.push_back(product);
                            after.push_back(product * chance(shown, outcome));
                        }
            double sumBefore = 0, sumAfter = 0, entropy = 0;
            for (std::size_t i = 0; i < before.size(); ++i) {
                sumBefore += before[i];
                sumAfter += after[i];
            }
            for (const double one : after)
                entropy -= one / sumAfter * std::log(one / sumAfter);
            expected += sumAfter / sumBefore * entropy;
        }
        EXPECT_NEAR(quest.expectedEntropy(shown), expected, 1e-12) << shown;
    }
}

// Without answers all values of the grid, and those between, are equally likely.
TEST(QuestPlus, EstimatesOfNothingAreThePrior) {
    const QuestPlus quest({Sigmoid::logistic, {0, 1}, {0, 1, 2, 3}, {1}, {0.5}, {0}});
    const QuestEstimate estimate = quest.estimate(QuestParameter::threshold, 0.9);
    EXPECT_NEAR(estimate.median, 1.5, 1e-12);
    EXPECT_NEAR(estimate.sd, 4 / std::sqrt(12.0), 1e-12); // uniform from -0.5 to 3.5
    EXPECT_NEAR(estimate.interval.low, -0.3, 1e-12);
    EXPECT_NEAR(estimate.interval.high, 3.3, 1e-12);
    EXPECT_NEAR(quest.estimate(QuestParameter::slope).width(), 0, 1e-12);
}

TEST(QuestPlus, AGridMustRiseAndBeInRange) {
    const auto make = [](const QuestGrid& grid) { return [grid] { const QuestPlus quest(grid); }; };
    EXPECT_THAT(make({Sigmoid::logistic, {1, 0}, {0}, {1}, {0.5}, {0}}),
                testing::ThrowsMessage<Error>(testing::HasSubstr("levels of a grid")));
    EXPECT_THROW(make({Sigmoid::logistic, {}, {0}, {1}, {0.5}, {0}})(), Error);
    EXPECT_THROW(make({Sigmoid::weibull, {0, 1}, {0}, {1}, {0.5}, {0}})(), Error);
    EXPECT_THROW(make({Sigmoid::logistic, {0}, {0}, {0}, {0.5}, {0}})(), Error);
    EXPECT_THROW(make({Sigmoid::logistic, {0}, {0}, {1}, {0.95}, {0.06}})(), Error);
}

struct Tally {
    double bias = 0, square = 0, coverage = 0; // of the threshold, log10 units
};

// Observers as the grid has them: any slope and lapse, and the threshold given, or any within the
// levels, two decades.
Tally observe(std::optional<double> threshold, int observers, int trials) {
    std::vector<double> levels;
    for (int i = 0; i <= 15; ++i)
        levels.push_back(-2 + i * 2 / 15.0);
    const QuestPlus fresh(questGrid(levels, 0.5));
    Tally tally;
    for (int observer = 0; observer < observers; ++observer) {
        Random random(20170310, "observer " + std::to_string(observer));
        const double drawn = -2 + 2 * random.uniform();
        const Psychometric truth{.threshold = threshold.value_or(drawn),
                                 .slope = std::exp2(1 + 5 * random.uniform()) / 2,
                                 .lapse = 0.06 * random.uniform()};
        QuestPlus quest = fresh;
        for (int trial = 0; trial < trials; ++trial) {
            const int level = quest.next();
            quest.answer(level,
                         random.uniform() < probability({.guess = 0.5}, truth,
                                                        levels[static_cast<std::size_t>(level)]));
        }
        const QuestEstimate estimate = quest.estimate(QuestParameter::threshold);
        const double error = estimate.median - truth.threshold;
        tally.bias += error / observers;
        tally.square += error * error / observers;
        if (estimate.interval.low <= truth.threshold && truth.threshold <= estimate.interval.high)
            tally.coverage += 1.0 / observers;
    }
    return tally;
}

// OBSCURA_OBSERVERS=1000 prints the figures of docs/measurement.md for fixed thresholds.
TEST(QuestPlus, IsUnbiasedAndItsIntervalsCover) {
    const Tally any = observe(std::nullopt, 1000, 60);
    EXPECT_LE(std::abs(any.bias), 0.02);
    EXPECT_NEAR(any.coverage, 0.95, 0.025);
    const char* observers = std::getenv("OBSCURA_OBSERVERS");
    for (const double threshold : {-1.5, -1.0, -0.5})
        for (const int trials : {60, 120, 240})
            if (observers) {
                const Tally fixed = observe(threshold, std::atoi(observers), trials);
                std::printf("threshold %.1f, %d trials: bias %.3f, RMSE %.3f log10 units, coverage "
                            "%.1f %%\n",
                            threshold, trials, fixed.bias, std::sqrt(fixed.square),
                            100 * fixed.coverage);
            }
    std::printf("any threshold, 60 trials: bias %.3f, RMSE %.3f, coverage %.1f %%\n", any.bias,
                std::sqrt(any.square), 100 * any.coverage);
}

} // namespace
} // namespace obscura
