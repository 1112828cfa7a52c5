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

// The share of right answers, after 200 trials to get there, of 100 simulated observers who are
// right with probability 1 / (1 + exp((level - 20) / 4)) on 41 levels.
double convergence(int down) {
    const Staircase staircase{.down = down, .reversals = 1000000, .trials = 1000000};
    int right = 0;
    for (std::uint64_t person = 0; person < 100; ++person) {
        Random random(person, "staircase");
        std::vector<Step> answers;
        for (int trial = 0; trial < 400; ++trial) {
            const int level = *nextLevel(staircase, 41, answers);
            const bool isRight = random.uniform() < 1 / (1 + std::exp((level - 20) / 4.0));
            answers.push_back(isRight ? Step::right : Step::wrong);
            right += isRight && trial >= 200;
        }
    }
    return right / 20000.0;
}

// Levitt 1971: where p to the power of `down` is one half, 70.7 and 79.4 %. The tolerance is three
// standard errors of independent answers; found were 0.4999, 0.7064 and 0.7917.
TEST(Staircase, ConvergesWhereLevittSays) {
    EXPECT_NEAR(convergence(1), 0.5, 0.01);
    EXPECT_NEAR(convergence(2), std::sqrt(0.5), 0.01);
    EXPECT_NEAR(convergence(3), std::cbrt(0.5), 0.01);
}

} // namespace
} // namespace obscura
