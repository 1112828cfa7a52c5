#include "base/error.h"
#include "bench/choose/budget.h"
#include "bench/measure/timing.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

// R: mean(x) + qt(0.95, 3) * sd(x) / 2 for x = c(0.1, 0.12, 0.09, 0.13)
TEST(Budget, BoundIsStudentsT) {
    const double values[] = {0.1, 0.12, 0.09, 0.13};
    EXPECT_NEAR(upperBound(values), 0.13148, 1e-5);
    EXPECT_TRUE(std::isinf(upperBound(std::span(values).first(1))));
}

TEST(Budget, WorstExcessComesFirst) {
    const std::string limits[] = {"rmse=0.1", "flip=0.3", "ms=2"};
    const Budget budget = budgetOf(limits);
    const ViewResult good{0.05, 0.1, 0, 1}, slow{0.05, 0.1, 0, 5}, wrong{0.2, 0.1, 0, 1};
    EXPECT_EQ(excess(budget, std::vector{good, good}), "");
    EXPECT_EQ(excess(budget, std::vector{good, slow}),
              "5 ms in 95 of 100 frames on the dearest view, budget 2");
    EXPECT_THAT(
        excess(budget, std::vector{wrong, wrong}),
        testing::StartsWith("RMSE 0.200 (at most 0.200 with 95 % confidence), budget 0.100"));
    // What was not measured meets no limit, and is worse than what is far over one.
    const ViewResult unknown{std::nan(""), 0.1, 0, 1}, endless{HUGE_VAL, 9, 0, 1};
    EXPECT_EQ(excess(budget, std::vector{unknown, good}),
              "RMSE unknown on 1 of 2 views, budget 0.100");
    EXPECT_THAT(excess(budget, std::vector{endless, endless}),
                testing::StartsWith("RMSE unknown on 2 of 2 views, budget 0.100; FLIP 9.000 (at"));
}

TEST(Budget, MistakesNameWhatThereIs) {
    const std::pair<std::string, std::string> mistakes[] = {
        {"rmse", "expected --limit NAME=NUMBER, found \"rmse\""},
        {"rmse=", "found \"rmse=\""},
        {"rmse=low", "found \"rmse=low\""},
        {"rmse=-1", "expected a number of at least 0, found \"rmse=-1\""},
        {"rmsee=1", "did you mean \"rmse\"?"},
        {"speed=3", "one of: rmse, flip, litFlip, flicker, ms"}};
    for (const auto& [wrong, expected] : mistakes) {
        const std::string limits[] = {wrong};
        EXPECT_THAT(test::errorOf([&] { budgetOf(limits); }), testing::HasSubstr(expected))
            << wrong;
    }
}

// R: quantile(c(4, 1, 3, 2), c(.05, .5, .95))
TEST(Milliseconds, PercentilesAreRsDefault) {
    const Milliseconds summary = summaryOf({4, 1, 3, 2});
    EXPECT_NEAR(summary.low, 1.15, 1e-12);
    EXPECT_NEAR(summary.median, 2.5, 1e-12);
    EXPECT_NEAR(summary.high, 3.85, 1e-12);
}

} // namespace
} // namespace obscura
