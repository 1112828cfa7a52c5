#include "base/error.h"
#include "experiment/timing_check.h"
#include "experiment/timing_count.h"
#include "experiment/timing_report.h"
#include "experiment/timing_ticks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr int planned = 30;

// A display of one refresh a second whose blanks are the whole numbers. Each swap is shown at the
// blank after the previous stamp, and stamped as late as `lateness` says (by the swap's number,
// from 0).
struct Screen1Hz {
    std::vector<double> lateness = std::vector<double>(100);
    std::vector<int> stalls = std::vector<int>(100); // blanks that pass before the swap
    int shown = 0;                                   // blanks for which the mask really was

    RefreshCount hold() {
        RefreshCount count(1, planned);
        int blank = 1000;
        const int onset = blank;
        for (std::size_t swap = 0; count.refreshes() < planned; ++swap, ++blank) {
            blank += stalls[swap];
            count.add(blank + lateness[swap]);
        }
        count.end(blank);
        shown = blank - onset;
        return count;
    }
};

TEST(RefreshCount, CountsSwapsOfASteadyDisplay) {
    Screen1Hz screen;
    EXPECT_EQ(screen.hold().refreshes(), planned);
    EXPECT_EQ(screen.shown, planned);
}

TEST(RefreshCount, MakesUpForMissedRefreshes) {
    for (const int stalled : {1, 2, 5}) {
        Screen1Hz screen;
        screen.stalls[10] = stalled;
        const RefreshCount count = screen.hold();
        EXPECT_EQ(screen.shown, planned) << stalled;
        EXPECT_EQ(count.refreshes(), planned) << stalled;
        EXPECT_EQ(count.missed(), 1) << stalled;
        EXPECT_EQ(count.intervals().size(), static_cast<std::size_t>(planned - stalled));
    }
}

// The goal: a mask never ends early. One late stamp anywhere, so that a long interval follows or
// precedes a short one, is no refresh that passed.
TEST(RefreshCount, NeverEndsAMaskEarlyForALateStamp) {
    for (std::size_t at = 0; at < planned; ++at)
        for (const double late : {0.3, 0.6, 0.8, 0.95}) {
            Screen1Hz screen;
            screen.lateness[at] = late;
            EXPECT_EQ(screen.hold().refreshes(), planned) << at << ", " << late;
            EXPECT_EQ(screen.shown, planned) << at << ", " << late;
        }
}

// Two stamps in a row have to be late by most of a refresh before one counts as passed.
TEST(RefreshCount, NeverEndsAMaskEarlyForTwoStampsThatAreLateByHalf) {
    for (std::size_t at = 0; at + 1 < planned; ++at) {
        Screen1Hz screen;
        screen.lateness[at] = screen.lateness[at + 1] = 0.6;
        screen.hold();
        EXPECT_EQ(screen.shown, planned) << at;
    }
}

// A swap that returns before its blank, or one stamped late, on time, late again.
TEST(RefreshCount, NeverEndsAMaskEarlyForAShortIntervalBeforeALongOne) {
    for (std::size_t at = 0; at + 2 < planned; ++at) {
        Screen1Hz screen;
        screen.lateness[at] = screen.lateness[at + 2] = 0.8;
        screen.hold();
        EXPECT_EQ(screen.shown, planned) << at;

        Screen1Hz early;
        early.lateness[at + 1] = -0.8;
        EXPECT_EQ(early.hold().refreshes(), planned) << at;
        EXPECT_EQ(early.shown, planned) << at;
    }
}

TEST(RefreshCount, ARefreshLostAtTheEndIsSaid) {
    Screen1Hz screen;
    screen.stalls[planned - 1] = 1;
    const RefreshCount count = screen.hold();
    EXPECT_EQ(count.refreshes(), screen.shown);
    EXPECT_GT(count.refreshes(), planned);
    EXPECT_EQ(count.missed(), 1);

    RefreshCount last(60, 2); // the image after it comes late
    last.add(0);
    last.add(1 / 60.0);
    last.end(3 / 60.0);
    EXPECT_EQ(last.refreshes(), 3);
    EXPECT_DOUBLE_EQ(last.seconds(), 3 / 60.0);
}

// A driver that takes two swaps ahead of the screen returns from the first ones at once.
TEST(RefreshCount, SwapsTakenAheadAreRefreshes) {
    RefreshCount count(1, planned);
    for (const double time : {5.0, 5.01, 5.02, 6.0, 7.0})
        count.add(time);
    EXPECT_EQ(count.refreshes(), 5);
    count.end(8);
    EXPECT_EQ(count.refreshes(), 5);
}

TEST(Ticks, AreCountedFromTheirBeginning) {
    const Ticks ticks(60);
    EXPECT_EQ(ticks.after(0), 1);
    EXPECT_EQ(ticks.after(0.01), 1);
    EXPECT_EQ(ticks.after(0.02), 2);
    EXPECT_EQ(ticks.after(3600), 216001) << "none is lost in an hour";
    EXPECT_DOUBLE_EQ(ticks.timeOf(216001), 3600 + 1 / 60.0);
}

TEST(Ticks, NoneIsGivenTwiceOrBeforeItsTime) {
    const auto start = std::chrono::steady_clock::now();
    const Ticks ticks(500);
    std::int64_t last = 0;
    for (int i = 0; i < 20; ++i) {
        const std::int64_t tick = ticks.await();
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        EXPECT_GT(tick, last);
        EXPECT_GE(passed.count(), ticks.timeOf(tick));
        last = tick;
    }
}

// What a double, a triple and a quadruple buffered display do after a pause; one without v-sync.
TEST(DisplayCheck, CountsSwapsTakenAhead) {
    const double frame = 1 / 60.0;
    EXPECT_EQ(queuedSwaps({frame * 0.9, frame, frame}, 60), 0);
    EXPECT_EQ(queuedSwaps({0.0002, frame * 0.9, frame}, 60), 1);
    EXPECT_EQ(queuedSwaps({0.0002, 0.0002, frame * 0.9}, 60), 2);
    EXPECT_EQ(queuedSwaps({0.002, 0.002, 0.002}, 60), std::nullopt);
}

struct Blanks {
    std::vector<gl::Onset> onsets;
    std::vector<double> now;

    Blanks() {
        for (int i = 0; i < 100; ++i) {
            onsets.push_back({5 + i / 59.94, 777000 + i});
            now.push_back(onsets.back().time + 0.0003);
        }
    }
    bool believed() const { return plausible(onsets, now, 60); }
};

TEST(DisplayCheck, BelievesBlanksThatAgreeWithTheClock) {
    EXPECT_TRUE(Blanks().believed());
    Blanks missed; // one swap two blanks late
    for (std::size_t i = 50; i < 100; ++i) {
        missed.onsets[i].time += 2 / 59.94;
        missed.onsets[i].blanks += 2;
        missed.now[i] += 2 / 59.94;
    }
    EXPECT_TRUE(missed.believed());
}

TEST(DisplayCheck, RefusesBlanksThatCannotBe) {
    Blanks none; // as drivers without a counter may say
    for (gl::Onset& onset : none.onsets)
        onset.blanks = 0;
    EXPECT_FALSE(none.believed());
    Blanks stuck;
    stuck.onsets[50].blanks = stuck.onsets[49].blanks;
    EXPECT_FALSE(stuck.believed());
    Blanks otherRate;
    for (std::size_t i = 0; i < 100; ++i)
        otherRate.onsets[i].blanks = 777000 + 2 * static_cast<int>(i);
    EXPECT_FALSE(otherRate.believed());
    Blanks otherClock;
    for (gl::Onset& onset : otherClock.onsets)
        onset.time += 1e9;
    EXPECT_FALSE(otherClock.believed());
    EXPECT_FALSE(plausible({}, {}, 60));
}

TEST(DisplayCheck, RefusesScaledDesktopsAndOtherColours) {
    DisplayCheck check;
    check.colourBits = {8, 8, 8};
    EXPECT_THAT(objectionTo(check), IsEmpty());
    check.contentScale = 1.25;
    EXPECT_THAT(objectionTo(check), HasSubstr("125 %"));
    check.contentScale = 1;
    check.colourBits = {5, 6, 5};
    EXPECT_THAT(objectionTo(check), HasSubstr("5, 6 and 5 bits"));
    check.colourBits = {10, 10, 10};
    EXPECT_THAT(objectionTo(check), Not(IsEmpty()));
}

TEST(DisplayCheck, SaysWhatItDoesNotKnow) {
    DisplayCheck check;
    check.unsynchronised = "too fast";
    const nlohmann::json json = spell(check);
    for (const char* key : {"buffering", "compositor", "variable_refresh"})
        EXPECT_EQ(json[key], "unknown");
    EXPECT_EQ(json["vsync"], "not honoured: too fast");
    check.unsynchronised = "";
    check.queued = 1;
    check.compositor = true;
    check.variable = false;
    const std::string words = inWords(check);
    EXPECT_THAT(words, HasSubstr("buffering: triple"));
    EXPECT_THAT(words, HasSubstr("v-sync honoured"));
}

// Four masks, worked out by hand: differences from 2000 ms of -0.1, 0, 0.1 and 16.7.
TimingRun sampleRun() {
    TimingRun run;
    run.refresh = {60, "none", "no vertical blank"};
    run.planned = 120;
    run.masks = {{1.9999, 120, 0}, {2.0, 120, 0}, {2.0001, 120, 1}, {2.0167, 121, 1}};
    return run;
}

TEST(TimingReport, HasWhatProgramsAskFor) {
    const nlohmann::json json = spell(sampleRun());
    EXPECT_EQ(json["masks"], 4);
    EXPECT_NEAR(json["mean_ms"].get<double>(), 2004.175, 1e-9);
    EXPECT_NEAR(json["sd_ms"].get<double>(), 8.35039, 1e-5); // Python: statistics.stdev
    EXPECT_NEAR(json["min_ms"].get<double>(), 1999.9, 1e-9);
    EXPECT_NEAR(json["max_ms"].get<double>(), 2016.7, 1e-9);
    EXPECT_EQ(json["wrong_frames"], 1);
    EXPECT_EQ(json["missed_intervals"], 2);
}

TEST(TimingReport, AMaskOffByHalfARefreshIsWrongWhateverWasCounted) {
    TimingRun run = sampleRun();
    run.masks = {{1.9917, 120, 0}, {1.9916, 120, 0}, {2.0084, 120, 0}};
    EXPECT_EQ(run.wrong(), 2);
}

TEST(TimingReport, PrintsATableBesidePeersAndAHistogram) {
    const std::string text = inWords(sampleRun());
    EXPECT_THAT(text, HasSubstr("Obscura, this run                                4  2004.175"));
    EXPECT_THAT(text, HasSubstr("page that counts 120 animation frames           50  1999.940"));
    EXPECT_THAT(text, HasSubstr("   -0.10     1 ####"));
    EXPECT_THAT(text, HasSubstr(">= +0.50     1 ####"));
    TimingRun other = sampleRun();
    other.seconds = 0.1;
    EXPECT_THAT(inWords(other), Not(HasSubstr("jsPsych"))) << "peers held 2 s";
}

TEST(TimingReport, SaysThatNothingWasMeasured) {
    TimingRun run;
    run.ended = "ended by SIGINT";
    EXPECT_EQ(inWords(run), "No mask was held.\nIt was ended by SIGINT before the last mask.\n");
    EXPECT_TRUE(spell(run)["mean_ms"].is_null());
    EXPECT_EQ(csv(run), "mask,ms,refreshes,missed_intervals\n");
    EXPECT_THAT(csv(sampleRun()), HasSubstr("\n4,2016.700000,121,1\n"));
}

} // namespace
} // namespace obscura
