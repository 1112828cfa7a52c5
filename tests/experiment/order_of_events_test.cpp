#include "base/files.h"
#include "experiment/session.h"
#include "protocols/reader/responses.h"
#include "tests/experiment/tiny_study.h"
#include "tests/experiment/trial_bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace obscura {
namespace {

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
    double show(const TrialMachine& trial) override {
        trial_ = &trial;
        return clock_ += 1 / 60.0;
    }
    std::vector<Event> events(bool wait) override {
        if (trial_->screen() == test::mask)
            return {};
        clock_ += wait ? patience_ : 1e-4;
        return press(trial_->screen() == test::question ? gl::Key::two : gl::Key::space);
    }
    bool rest() override { return true; }
    void thank() override {}

  private:
    std::vector<Event> press(gl::Key key) const {
        return {{Event::Kind::press, clock_, key}, {Event::Kind::release, clock_, key}};
    }

    double patience_;
    const TrialMachine* trial_ = nullptr; // what it shows
    double clock_ = 0;
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

} // namespace
} // namespace obscura
