#include "experiment/refresh.h"
#include "gl/sleep_watch.h"

#include <gtest/gtest.h>

#include <numeric>

namespace obscura {
namespace {

std::vector<double> jittered(double interval, double jitter) {
    std::vector<double> intervals;
    for (int i = 0; i < 100; ++i)
        intervals.push_back(interval + (i % 2 ? jitter : -jitter));
    return intervals;
}

// The worked figures of psychophysics.md 7.
TEST(Refresh, TwoSecondsInWholeRefreshes) {
    EXPECT_EQ(maskRefreshes(2, 60), 120);
    EXPECT_EQ(maskRefreshes(2, 59.951), 120);
    EXPECT_EQ(maskRefreshes(2, 59.94), 120);
    EXPECT_EQ(maskRefreshes(2, 75), 150);
    EXPECT_EQ(maskRefreshes(2, 143.86), 288);
    EXPECT_EQ(maskRefreshes(2, 164.9), 330);
    EXPECT_EQ(maskRefreshes(2, 100), 200);
    EXPECT_EQ(maskRefreshes(2, 240), 480);
    EXPECT_EQ(maskRefreshes(0.001, 60), 1);
    EXPECT_EQ(maskRefreshes(2, 60.12), 120); // ends 0.24 of a refresh too soon
    EXPECT_EQ(maskRefreshes(2, 60.13), 121); // would end 0.26 too soon
}

TEST(Refresh, SteadySwapsAtTheReportedRateAreBelieved) {
    const Refresh refresh = judgeRefresh(jittered(1 / 59.94, 0.0003), 60);
    EXPECT_EQ(refresh.source, "finish");
    EXPECT_NEAR(refresh.hz, 59.94, 1e-3);
    EXPECT_EQ(refresh.doubt, "");
}

TEST(Refresh, AFewMissedFlipsDoNotMoveTheRate) {
    std::vector<double> intervals = jittered(1 / 60.0, 0.0001);
    intervals[10] = intervals[50] = 2 / 60.0;
    const Refresh refresh = judgeRefresh(intervals, 60);
    EXPECT_EQ(refresh.source, "finish");
    EXPECT_NEAR(refresh.hz, 60, 0.02); // the mean of all would say 58.8
}

TEST(Refresh, SwapsThatReturnAtOnceAreUntimed) {
    for (const int reported : {0, 60, 75}) {
        const Refresh refresh = judgeRefresh(jittered(0.002, 0.0001), reported);
        EXPECT_EQ(refresh.source, "none");
        EXPECT_EQ(refresh.hz, 60);
        EXPECT_NE(refresh.doubt, "");
    }
}

TEST(Refresh, UnsteadySwapsAreUntimed) {
    std::vector<double> intervals; // triple buffering: at once, then two frames
    for (int i = 0; i < 99; ++i)
        intervals.push_back(i % 3 == 0 ? 0.0005 : i % 3 == 1 ? 1 / 60.0 : 2 / 60.0);
    EXPECT_EQ(judgeRefresh(intervals, 60).source, "none");
    EXPECT_EQ(judgeRefresh({}, 60).source, "none");
}

// A display on which driver and program both wait shows every other refresh (PsychoPy #1139).
TEST(Refresh, HalfTheReportedRateIsUntimed) {
    EXPECT_EQ(judgeRefresh(jittered(1 / 30.0, 0.0001), 60).source, "none");
}

TEST(Refresh, SummaryCountsIntervals) {
    const IntervalSummary summary = summarise({1 / 60.0, 1 / 60.0, 2 / 60.0, 1}, 60);
    EXPECT_EQ(summary.count, 4);
    EXPECT_NEAR(summary.mean, (4 / 60.0 + 1) / 4, 1e-12);
    EXPECT_EQ(summary.least, 1 / 60.0);
    EXPECT_EQ(summary.most, 1);
    EXPECT_EQ(std::accumulate(summary.histogram.begin(), summary.histogram.end(), 0), 4);
    EXPECT_EQ(summary.histogram.at(20), 1);
    EXPECT_EQ(summary.histogram.at(30), 1);
    EXPECT_EQ(summarise({}, 60).count, 0);
}

double bootClock = 100, steadyClock = 100, pause = 0; // `pause`: while both are read, once

// A machine that was suspended for a minute, and one that was busy for a second.
TEST(SleepWatch, OnlyAClockThatStoodStillIsASleep) {
    gl::SleepWatch watch([] { return bootClock; },
                         [] {
                             steadyClock += pause;
                             bootClock += pause;
                             pause = 0;
                             return steadyClock;
                         });
    EXPECT_FALSE(watch.slept());
    bootClock += 60;
    EXPECT_TRUE(watch.slept());
    EXPECT_FALSE(watch.slept());
    for (double* clock : {&bootClock, &steadyClock})
        *clock += 3600;
    EXPECT_FALSE(watch.slept());
    pause = 1;
    EXPECT_FALSE(watch.slept());
    EXPECT_FALSE(watch.slept());
    EXPECT_FALSE(gl::SleepWatch().slept()) << "this machine's own clocks";
}

} // namespace
} // namespace obscura
