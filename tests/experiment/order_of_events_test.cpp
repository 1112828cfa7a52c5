#include "base/files.h"
#include "experiment/session.h"
#include "protocols/reader/responses.h"
#include "tests/experiment/tiny_study.h"
#include "tests/experiment/trial_bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// A person who presses the key that the next screen asks for while it is still on its way: the
// program learns of the press only after the swap has returned, with a stamp later than the onset.
// Once that screen is known to be on, the person waits for `patience` seconds and presses again.
class HastyObserver : public Observer {
  public:
    explicit HastyObserver(double patience) : patience_(patience) {}

    Refresh refresh() const override { return {60, "none", "scripted"}; }
    void describe(nlohmann::ordered_json&) const override {}
    bool instruct() override { return true; }
    void prepare(const Upcoming&) override {}
    void preparePage(const Phase&) override {}
    double show(const TrialMachine& trial) override {
        shown_ = trial.screen();
        return clock_ += 1 / 60.0;
    }
    const std::vector<Event>& events(bool wait) override {
        if (shown_ == test::mask)
            return nothing();
        clock_ += wait ? patience_ : 1e-4;
        return press(shown_ == test::question ? gl::Key::two : gl::Key::space);
    }
    bool rest() override { return true; }
    void thank() override {}
    void decline() override {}

  protected:
    const std::vector<Event>& press(gl::Key key) {
        return events_ = {{Event::Kind::press, clock_, key}, {Event::Kind::release, clock_, key}};
    }
    const std::vector<Event>& nothing() { return events_ = {}; }

  private:
    double patience_;
    Screen shown_ = 0;
    double clock_ = 0;
    std::vector<Event> events_;
};

// A person who types faster than pages are drawn: each key arrives while the page that shows what
// the one before did is on its way.
class QuickObserver : public HastyObserver {
  public:
    QuickObserver() : HastyObserver(1) {}

    double show(const TrialMachine& trial) override {
        trial_ = &trial;
        screens.push_back(trial.screen());
        return HastyObserver::show(trial);
    }
    const std::vector<Event>& events(bool wait) override {
        if (!trial_->form() || (!wait && trial_->form()->changes() == 0))
            return nothing();
        return press(trial_->form()->answered(static_cast<std::size_t>(trial_->form()->focus()))
                         ? gl::Key::enter
                         : gl::Key::two);
    }
    std::vector<Screen> screens;

  private:
    const TrialMachine* trial_ = nullptr;
};

class OrderOfEventsTest : public testing::Test {
  protected:
    test::TemporaryFolder folder;
    std::vector<Response> rows;
    std::string journal;

    void run(double minimumView, double patience) {
        const test::TinyStudy tiny =
            test::writeTinyStudy(folder.path(), {.minimumView = minimumView});
        const Study study = openStudy(tiny.protocol, tiny.stimuli);
        const DataFolder data(folder.path() / "data", study.protocol);
        const SessionId session{"P01", 1, false};
        HastyObserver observer(patience);
        ASSERT_TRUE(runSession(study, data, session, observer));
        rows = readResponses(data.rows(session), false).rows;
        journal = readFile(data.journal(session));
        ASSERT_EQ(rows.size(), 7u);
    }
};

TEST_F(OrderOfEventsTest, WhatWasPressedBeforeAScreenWasKnownToBeOnIsNoAnswerToIt) {
    run(0, 1);
    for (const Response& row : rows) {
        EXPECT_GE(row.view1Ms, 1000);
        EXPECT_GE(row.view2Ms, 1000);
        EXPECT_GE(row.decisionRtMs, 1000);
        EXPECT_EQ(row.earlyPressesInMask, 1) << "the one while image 2 was on its way";
    }
    EXPECT_THAT(journal, Not(HasSubstr("presses_ignored")));
}

TEST_F(OrderOfEventsTest, PressesBeforeTheMinimumViewAreJournalled) {
    run(0.5, 0.2); // twice too soon in each image
    for (const Response& row : rows) {
        EXPECT_GE(row.view1Ms, 500);
        EXPECT_GE(row.view2Ms, 500);
    }
    EXPECT_THAT(journal, HasSubstr("\"trial\":7,\"count\":4"));
}

// Two ratings, and then nothing more: what followed the last key was taken for shown, and the
// machine ran over the end of its phases.
TEST_F(OrderOfEventsTest, AnswersThatOutrunTheirPagesLeadToScreensThatAreShown) {
    const fs::path protocol = OBSCURA_SOURCE "/protocols/kozlowski-kautz-2007.toml";
    test::writeNoiseStimuli(readProtocol(protocol), folder.path() / "stimuli");
    const Study study = openStudy(protocol, folder.path() / "stimuli");
    const DataFolder data(folder.path() / "data", study.protocol);
    QuickObserver observer;
    ASSERT_TRUE(runSession(study, data, {"P01", 1, false}, observer));
    EXPECT_EQ(std::count(observer.screens.begin(), observer.screens.end(), 0), 9 * 30);
    const std::string answers = readFile(data.answers({"P01", 1, false}));
    EXPECT_EQ(std::count(answers.begin(), answers.end(), '\n'), 1 + 9 * 2);
    for (const Screen screen : observer.screens)
        EXPECT_TRUE(screen == 0 || screen == 1) << screen;
}

} // namespace
} // namespace obscura
