#include "base/random.h"
#include "experiment/staircase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace obscura {
namespace {

// + right, - wrong, . interrupted.
std::vector<Step> steps(const std::string& answers) {
    std::vector<Step> result;
    for (const char answer : answers)
        result.push_back(answer == '+' ? Step::right : answer == '-' ? Step::wrong : Step::none);
    return result;
}

std::string levels(const Staircase& staircase, int count, const std::string& answers) {
    std::string result;
    for (std::size_t i = 0; i <= answers.size(); ++i) {
        const auto level = nextLevel(staircase, count, steps(answers.substr(0, i)));
        result += level ? std::to_string(*level) : std::string("e");
    }
    return result;
}

// By hand, as in Levitt's figure of a 2-down 1-up run: two right answers lead on, one wrong one
// back. Steps: 0 to 1, 1 to 2, back to 1 (reversal 1), to 2 (2), back to 1 (3), back to 0, to 1
// (4).
TEST(Staircase, FollowsARunWorkedByHand) {
    const Staircase four{.reversals = 4};
    EXPECT_EQ(levels(four, 5, "++++-++--++"), "00112112100e");
}

TEST(Staircase, ARightAnswerBeforeAWrongOneCountsForNothing) {
    EXPECT_EQ(levels({}, 5, "+-+-+-"), "0000000");
    EXPECT_EQ(levels({}, 5, "+++-+-"), "0011000");
    EXPECT_EQ(levels({.down = 3}, 5, "++-+++"), "0000001");
    EXPECT_EQ(levels({.down = 1, .up = 2}, 5, "++-+-"), "012233");
}

TEST(Staircase, AStepBeyondTheEndsIsNoneAndNoReversal) {
    EXPECT_EQ(levels({.reversals = 1}, 2, "--++++++"), "000011111");
    EXPECT_EQ(levels({.reversals = 1}, 2, "++++-"), "00111e");
}

TEST(Staircase, InterruptedTrialsLeadNowhereButCount) {
    EXPECT_EQ(levels({}, 5, "+.+."), "00011");
    EXPECT_EQ(levels({.trials = 4}, 5, "...."), "0000e");
}

TEST(Staircase, EndsAtTheMostTrials) {
    EXPECT_EQ(levels({.reversals = 100, .trials = 6}, 9, "++++++"), "001122e");
}

// A simulated observer with a logistic function over 41 levels, right with 1 / (1 + exp((x - 20) /
// 2)). The share right at the mean level of the second half of a run is where p^down = 1/2: 70.7 %
// for two, 79.4 % for three (Levitt 1971). The tolerance of 2.5 % covers the bias of steps of a
// quarter of the function's width (its slope there makes a step 0.1 of p wide) and sampling.
double convergence(int down) {
    const Staircase staircase{.down = down, .reversals = 1000000, .trials = 1000000};
    const auto right = [](double level) { return 1 / (1 + std::exp((level - 20) / 2)); };
    double sum = 0;
    int count = 0;
    for (std::uint64_t person = 0; person < 100; ++person) {
        Random random(person, "staircase");
        std::vector<Step> answers;
        for (int trial = 0; trial < 400; ++trial) {
            const int level = *nextLevel(staircase, 41, answers);
            answers.push_back(random.uniform() < right(level) ? Step::right : Step::wrong);
            if (trial >= 200) {
                sum += level;
                ++count;
            }
        }
    }
    return right(sum / count);
}

TEST(Staircase, ConvergesWhereLevittSays) {
    EXPECT_NEAR(convergence(2), std::sqrt(0.5), 0.025);
    EXPECT_NEAR(convergence(3), std::cbrt(0.5), 0.025);
    EXPECT_NEAR(convergence(1), 0.5, 0.025);
}

} // namespace
} // namespace obscura
