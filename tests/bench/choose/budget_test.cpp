#include "base/error.h"
#include "bench/choose/budget.h"
#include "bench/measure/timing.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Budget asked(const std::vector<std::string>& limits) { return budgetOf(limits); }

ViewResult result(double rmse, double flip, double milliseconds, double jod = 9) {
    ViewResult view;
    view.rmse = rmse;
    view.flip = flip;
    view.milliseconds = milliseconds;
    view.jod = jod;
    return view;
}

// R: mean(x) + qt(c(0.95, 1 - 0.05 / 3), 3) * sd(x) / 2 for x = c(0.1, 0.12, 0.09, 0.13)
TEST(Budget, BoundIsStudentsT) {
    const double values[] = {0.1, 0.12, 0.09, 0.13};
    EXPECT_NEAR(upperBound(values, 0.95), 0.13148, 1e-5);
    EXPECT_NEAR(upperBound(values), 0.14415, 1e-5);
    EXPECT_TRUE(std::isinf(upperBound(std::span(values).first(1))));
}

TEST(Budget, WorstExcessComesFirst) {
    const Budget budget = asked({"rmse=0.1", "flip=0.3", "ms=2"});
    const ViewResult good = result(0.05, 0.1, 1), slow = result(0.05, 0.1, 5),
                     wrong = result(0.2, 0.1, 1);
    EXPECT_EQ(excess(budget, std::vector{good, good}), "");
    EXPECT_EQ(excess(budget, std::vector{good, slow}),
              "5 ms in 95 of 100 frames on the dearest view, limit 2");
    EXPECT_THAT(excess(budget, std::vector{wrong, wrong}),
                StartsWith("RMSE 0.200 (at most 0.200 with 98.3 % confidence), limit 0.100"));
    // What was not measured meets no limit, and is worse than what is far over one.
    const ViewResult unknown = result(std::nan(""), 0.1, 1), endless = result(HUGE_VAL, 9, 1);
    EXPECT_EQ(excess(budget, std::vector{unknown, good}),
              "RMSE unknown on 1 of 2 views, limit 0.100");
    EXPECT_THAT(excess(budget, std::vector{endless, endless}),
                StartsWith("RMSE unknown on 2 of 2 views, limit 0.100; FLIP 9.000 (at"));
}

// Of JOD more is better: what counts is how little it may be.
TEST(Budget, JodIsALeast) {
    const Budget budget = asked({"jod=9"});
    const ViewResult good = result(0, 0, 0, 9.5), bad = result(0, 0, 0, 8.5),
                     fair = result(0, 0, 0, 9.1);
    EXPECT_EQ(excess(budget, std::vector{good, good}), "");
    EXPECT_EQ(excess(budget, std::vector{bad, bad}),
              "predicted JOD 8.50 (at least 8.50 with 98.3 % confidence), limit 9.00");
    // R: 9.3 - qt(1 - 0.05 / 3, 1) * sd(c(9.5, 9.1)) / sqrt(2) = 5.484
    EXPECT_EQ(excess(budget, std::vector{good, fair}),
              "predicted JOD 9.30 (at least 5.48 with 98.3 % confidence), limit 9.00");
    EXPECT_EQ(excess(budget, std::vector{ViewResult{}, good}),
              "predicted JOD unknown on 1 of 2 views, limit 9.00");
}

// R: for x = c(0.1, 0.12, 0.09) the bound is 0.15042, and for c(9.4, 9.2, 9.5) JOD 8.8958. The
// limits that are named admit what they are named for, and a little stricter ones do not.
TEST(Budget, AdmittingLimitsAdmit) {
    const std::vector<ViewResult> views = {result(0.1, 0.2, 3.01, 9.4), result(0.12, 0.2, 3, 9.2),
                                           result(0.09, 0.2, 2, 9.5)};
    EXPECT_EQ(admitting(asked({"rmse=0.2", "flip=0.21"}), views), "");
    EXPECT_EQ(admitting(asked({"rmse=0.1", "flip=0.21", "ms=2"}), views), "ms=3.1 rmse=0.151");
    EXPECT_EQ(excess(asked({"rmse=0.151", "ms=3.1"}), views), "");
    EXPECT_NE(excess(asked({"rmse=0.150", "ms=3.1"}), views), "");
    const std::string jod = admitting(asked({"jod=9.3"}), views);
    EXPECT_EQ(jod, "jod=8.89");
    EXPECT_EQ(excess(asked({jod}), views), "");
    EXPECT_NE(excess(asked({"jod=8.9"}), views), "");
    EXPECT_EQ(admitting(asked({"litFlip=0.1"}), {}), ""); // nothing measured
}

// R: x <- c(0.08, 0.11, 0.09, 0.12); n views are enough when
// mean(x) + qt(1 - 0.05 / 3, n - 1) * sd(x) / sqrt(n) <= 0.11: 17 give 0.11031,
// 18 give 0.10996
TEST(Budget, MoreViewsNarrowTheBound) {
    const std::vector<ViewResult> views = {result(0.08, 0, 0), result(0.11, 0, 0),
                                           result(0.09, 0, 0), result(0.12, 0, 0)};
    const auto needed = [&](const std::string& limit) {
        return viewsNeeded(standings(asked({limit}), views).front());
    };
    EXPECT_EQ(needed("rmse=0.11"), 18);
    EXPECT_EQ(needed("rmse=0.0999"), std::nullopt); // the mean is 0.1
    EXPECT_EQ(needed("rmse=0.1001"), std::nullopt); // thousands
    EXPECT_EQ(needed("rmse=9"), 2);
}

TEST(Budget, TheBestWithinATime) {
    const std::string none[] = {""};
    const Measure& jod = measureNamed("jod");
    const Budget budget = budgetOf(std::span(none).first(0), "ms=2", &jod);
    EXPECT_EQ(budget.best, &jod);
    EXPECT_EQ(budget.milliseconds, 2);
    const std::string limits[] = {"ms=2"};
    EXPECT_THAT(test::errorOf([&] { budgetOf(limits); }), HasSubstr("--budget ms=2"));
    EXPECT_EQ(budgetOf(limits, "", nullptr, true).milliseconds, 2); // people's limit comes besides
    EXPECT_THAT(test::errorOf([&] { budgetOf(limits, "ms=2", &jod); }), HasSubstr("found both"));
    EXPECT_THAT(test::errorOf([&] { budgetOf(std::span(none).first(0), "rmse=2", &jod); }),
                HasSubstr("ms"));
    EXPECT_THAT(test::errorOf([&] { budgetOf(std::span(none).first(0), "ms=0", &jod); }),
                HasSubstr("expected milliseconds above 0"));
}

TEST(Budget, MistakesNameWhatThereIs) {
    const std::pair<std::string, std::string> mistakes[] = {
        {"rmse", "expected --limit NAME=NUMBER, found \"rmse\""},
        {"rmse=", "found \"rmse=\""},
        {"rmse=low", "found \"rmse=low\""},
        {"rmse=-1", "expected a number of at least 0, found \"rmse=-1\""},
        {"jod=10", "from 0 to less than 10, which only the truth itself has, found \"jod=10\""},
        {"rmsee=1", "did you mean \"rmse\"?"},
        {"speed=3", "one of: rmse, flip, litFlip, jod, flicker, ms"}};
    for (const auto& [wrong, expected] : mistakes)
        EXPECT_THAT(test::errorOf([&, text = wrong] { asked({text}); }), HasSubstr(expected))
            << wrong;
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
