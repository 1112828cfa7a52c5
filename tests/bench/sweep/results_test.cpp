#include "bench/sweep/results.h"
#include "tests/bench/sweep/sample_sweep.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>

namespace obscura {
namespace {

TEST(SweepResults, AreReadBackExactly) {
    const Sweep sweep = test::smallSweep();
    ErrorsResult errors{sweep.rows[0], "a \"renderer\", 256 bits"};
    errors.errors.thumbnail = "thumbnails/é.png";
    errors.errors.raw.rmse = 0.1 + 0.2;
    errors.errors.depthRaw.bias = -0.0;
    errors.errors.matched.flip = 5e-324;
    ASSERT_TRUE(std::isnan(errors.errors.matched.jod));
    const ErrorsResult again = errorsIn(errorsResult(errors));
    EXPECT_EQ(errorsResult(again), errorsResult(errors));
    EXPECT_EQ(again.renderer, errors.renderer);
    EXPECT_EQ(again.errors.thumbnail, errors.errors.thumbnail);
    EXPECT_EQ(again.errors.raw.rmse, 0.1 + 0.2);
    EXPECT_TRUE(std::signbit(again.errors.depthRaw.bias));
    EXPECT_EQ(again.errors.matched.flip, 5e-324);
    EXPECT_EQ(again.errors.litMatched.jod, errors.errors.litMatched.jod);
    EXPECT_TRUE(std::isnan(again.errors.matched.jod));

    TimesResult times{sweep.machine, {sweep.rows[0], sweep.rows[1]}, sweep.growth};
    times.rows[1].starcraftRepeat = std::nan("");
    const TimesResult same = timesIn(timesResult(times));
    EXPECT_EQ(timesResult(same), timesResult(times));
    ASSERT_EQ(same.rows.size(), 2u);
    EXPECT_EQ(same.rows[1].total.high, sweep.rows[1].total.high);
    EXPECT_EQ(same.rows[0].work, sweep.rows[0].work);
    EXPECT_TRUE(std::isnan(same.rows[1].starcraftRepeat));
    EXPECT_EQ(same.rows[0].frames, 200);
    EXPECT_EQ(same.machine.method, sweep.machine.method);
    EXPECT_EQ(same.growth.size(), sweep.growth.size());

    const Fitted fitted{{"power", -1.2345678901234567}, {"radiusMultiplier", 1e-3}};
    EXPECT_EQ(fitIn(fitResult(fitted)), fitted);
}

TEST(SweepResults, OfAnotherKindAreRefused) {
    for (const char* text : {"", "{}", "[1, 2]", "made", "{\"fitted\": 3}"}) {
        EXPECT_THAT(test::errorOf([&] { fitIn(text); }), testing::HasSubstr("expected what a unit"))
            << text;
        EXPECT_THAT(test::errorOf([&] { errorsIn(text); }), testing::HasSubstr("name another"));
        EXPECT_THAT(test::errorOf([&] { timesIn(text); }), testing::HasSubstr("name another"));
    }
}

} // namespace
} // namespace obscura
