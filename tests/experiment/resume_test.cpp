#include "base/error.h"
#include "base/files.h"
#include "experiment/session.h"
#include "experiment/simulated.h"
#include "protocols/reader/responses.h"
#include "tests/experiment/shipped_studies.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

const SessionId session{"S1", 1, true};

// What a simulated participant was about to be shown, trial by trial; the process dies before the
// first image of a trial, or while it is on view.
class Mortal : public SimulatedObserver {
  public:
    using SimulatedObserver::SimulatedObserver;

    int diesBefore = 0, diesIn = 0; // trials; 0 for never
    std::vector<PlannedTrial> seen;

    void prepare(const Upcoming& trial) override {
        if (trial.index == diesBefore)
            ::_exit(0);
        index_ = trial.index;
        seen.push_back(trial.planned);
        SimulatedObserver::prepare(trial);
    }
    double show(const TrialMachine& trial) override {
        const double time = SimulatedObserver::show(trial);
        if (index_ == diesIn && trial.screen() > 0 && !trial.form())
            ::_exit(0);
        return time;
    }

  private:
    int index_ = 0;
};

std::vector<json> entriesOf(const fs::path& journal, const std::string& event) {
    std::vector<json> entries;
    std::istringstream lines(readFile(journal));
    for (std::string line; std::getline(lines, line);)
        if (json entry = json::parse(line); entry["event"] == event)
            entries.push_back(std::move(entry));
    return entries;
}

class ResumeTest : public testing::Test {
  protected:
    test::TemporaryFolder temporary;
    Study study;

    void open(const fs::path& protocol) {
        test::writeNoiseStimuli(readProtocol(protocol), temporary.path() / "stimuli");
        study = openStudy(protocol, temporary.path() / "stimuli");
    }
    void openTiny(const std::string& ordering = "scheme = \"williams\"") {
        const test::TinyStudy tiny = test::writeTinyStudy(
            temporary.path(), {.width = 16, .height = 16, .ordering = ordering});
        study = openStudy(tiny.protocol, tiny.stimuli);
    }
    DataFolder folder(const std::string& name = "data") const {
        return DataFolder(temporary.path() / name, study.protocol);
    }
    Mortal mortal() const { return {study.protocol, 1, session.participant}; }

    // In a process of its own, which dies.
    void dieIn(const DataFolder& data, int before, int in) const {
        const pid_t child = ::fork();
        if (child == 0) {
            Mortal observer = mortal();
            observer.diesBefore = before;
            observer.diesIn = in;
            runSession(study, data, session, observer);
            ::_exit(1);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_EQ(status, 0) << "it was to die within the session";
    }
    std::vector<PlannedTrial> goOn(const DataFolder& data) const {
        Mortal observer = mortal();
        EXPECT_TRUE(resumeSession(study, data, brokenSession(study, data, session), observer));
        return observer.seen;
    }
    // All that one who is never disturbed sees.
    std::vector<PlannedTrial> undisturbed(const std::string& name = "undisturbed") const {
        Mortal observer = mortal();
        EXPECT_TRUE(runSession(study, folder(name), session, observer));
        return observer.seen;
    }
};

// Of seven trials, broken off before and in the first, the last, and one between.
TEST_F(ResumeTest, NothingIsSeenTwiceAndNothingIsLeftOut) {
    openTiny();
    const std::vector<PlannedTrial> all = undisturbed();
    ASSERT_EQ(all.size(), 7u);
    for (const int trial : {1, 4, 7})
        for (const bool halfSeen : {false, true}) {
            SCOPED_TRACE(fmt::format("{} {}", halfSeen ? "in" : "before", trial));
            const DataFolder data = folder(fmt::format("{}{}", halfSeen ? "in" : "before", trial));
            dieIn(data, halfSeen ? 0 : trial, halfSeen ? trial : 0);
            const std::vector<PlannedTrial> rest(all.begin() + trial - 1 + halfSeen, all.end());
            EXPECT_EQ(goOn(data), rest);

            std::vector<int> numbers;
            for (const Response& row : readResponses(data.rows(session), false).rows)
                numbers.push_back(row.trialIndex);
            std::vector<int> expected = {1, 2, 3, 4, 5, 6, 7};
            if (halfSeen)
                expected.erase(expected.begin() + trial - 1);
            EXPECT_EQ(numbers, expected);

            const auto resumed = entriesOf(data.journal(session), "session_resumed");
            ASSERT_EQ(resumed.size(), 1u);
            EXPECT_EQ(resumed[0]["trials"], trial - 1 + halfSeen);
            EXPECT_EQ(resumed[0]["half_seen"].size(), halfSeen ? 1u : 0u);
            const auto slots = Ledger(data.ledger()).records();
            ASSERT_EQ(slots.size(), 1u);
            EXPECT_EQ(slots[0].state, SlotState::completed);
        }
}

TEST_F(ResumeTest, ItCanBreakOffAgain) {
    openTiny();
    const std::vector<PlannedTrial> all = undisturbed();
    const DataFolder data = folder();
    dieIn(data, 0, 2);
    const pid_t child = ::fork();
    if (child == 0) {
        Mortal observer = mortal();
        observer.diesIn = 5;
        resumeSession(study, data, brokenSession(study, data, session), observer);
        ::_exit(1);
    }
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(goOn(data), std::vector<PlannedTrial>(all.begin() + 5, all.end()));
    EXPECT_EQ(entriesOf(data.journal(session), "trial_started").size(), 7u);
    EXPECT_EQ(readResponses(data.rows(session), false).rows.size(), 5u);
    const json sidecar = json::parse(readFile(data.sidecar(session)));
    EXPECT_EQ(sidecar["end_reason"], "completed");
    ASSERT_EQ(sidecar["resumed"].size(), 2u);
    EXPECT_EQ(sidecar["resumed"][1]["half_seen"].size(), 2u);
    EXPECT_EQ(sidecar["resumed"][1]["trials_before"], 5);
    EXPECT_TRUE(sidecar["resumed"][1].contains("mask_intervals"));
    EXPECT_FALSE(sidecar.contains("mask_intervals"));
}

// Where answers decide the order, those before the break count: each trial is the one that a
// participant who was never disturbed would have seen.
class ResumeAdaptiveTest : public ResumeTest, public testing::WithParamInterface<const char*> {};

TEST_P(ResumeAdaptiveTest, GoesOnWhereItStood) {
    open(fmt::format("{}/protocols/{}.toml", OBSCURA_SOURCE, GetParam()));
    const DataFolder data = folder();
    dieIn(data, 10, 0);
    const BrokenSession broken = brokenSession(study, data, session);
    const std::vector<PlannedTrial> all = undisturbed();
    ASSERT_EQ(broken.history.size(), 9u);
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_EQ(broken.history[i].trial, all[i]);
    EXPECT_EQ(next(study.protocol, broken.slot, broken.history), all[9]);
    EXPECT_EQ(goOn(data).front(), all[9]);
}

INSTANTIATE_TEST_SUITE_P(Schemes, ResumeAdaptiveTest,
                         testing::Values("staircase", "quest-plus", "active-pairs"),
                         [](const auto& protocol) {
                             std::string name = protocol.param;
                             std::erase(name, '-');
                             return name;
                         });

// The last break before the crash is taken anew, those before it are over.
TEST_F(ResumeTest, BreaksBetweenTrialsAreNoTrials) {
    openTiny("scheme = \"williams\"\nbreakEvery = 2");
    const DataFolder data = folder();
    dieIn(data, 4, 0);
    const BrokenSession broken = brokenSession(study, data, session);
    EXPECT_EQ(broken.trials, 3);
    EXPECT_EQ(broken.history.size(), 4u);
    EXPECT_EQ(goOn(data).size(), 4u);
}

// Killed after the last row and before the ledger knew.
TEST_F(ResumeTest, WhatHasNothingLeftIsCompleted) {
    openTiny();
    const DataFolder data = folder();
    const pid_t child = ::fork();
    if (child == 0) {
        Mortal observer = mortal();
        runSession(study, data, session, observer);
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    const fs::path journal = data.journal(session);
    std::string text = readFile(journal);
    text.resize(text.rfind('\n', text.size() - 2) + 1); // session_ended
    writeFile(journal, text);
    std::string ledger = readFile(data.ledger());
    ledger.resize(ledger.find('\n') + 1); // completed
    writeFile(data.ledger(), ledger);
    EXPECT_THAT(goOn(data), IsEmpty());
    EXPECT_EQ(Ledger(data.ledger()).records().at(0).state, SlotState::completed);
    EXPECT_EQ(endOf(journal), "completed");
}

class ResumeRefused : public ResumeTest {
  protected:
    void SetUp() override {
        openTiny();
        dieIn(folder(), 4, 0);
    }
    fs::path journal() const { return folder().journal(session); }
    // The time of the last entry becomes another.
    void breakOff(std::time_t time) const {
        std::string text = readFile(journal());
        const std::size_t at = text.rfind("\"time\":\"") + 8;
        char stamp[32];
        std::strftime(stamp, sizeof stamp, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time));
        writeFile(journal(), text.replace(at, 20, stamp));
    }
    void expectRefused(const std::string& reason) const {
        EXPECT_THAT([&] { brokenSession(study, folder(), session); },
                    ThrowsMessage<Error>(HasSubstr(reason)));
    }
};

TEST_F(ResumeRefused, AfterItsTime) {
    breakOff(std::time(nullptr) - 59 * 60);
    EXPECT_NO_THROW(brokenSession(study, folder(), session));
    breakOff(std::time(nullptr) - 61 * 60);
    expectRefused("it broke off 61 minutes ago, and the study allows 60 (resumeMinutes)");
    study.protocol.ordering.resumeMinutes = 90;
    EXPECT_NO_THROW(brokenSession(study, folder(), session));
    study.protocol.ordering.resumeMinutes = 0;
    expectRefused("lets nobody go on");
}

TEST_F(ResumeRefused, WhenTheClockWasSetBack) {
    breakOff(std::time(nullptr) + 3600);
    expectRefused("clock was set back");
}

TEST_F(ResumeRefused, WhereThereIsNoneOrItWasCompleted) {
    EXPECT_THAT(
        [&] {
            brokenSession(study, folder(), {"S2", 1, true});
        },
        ThrowsMessage<Error>(HasSubstr("it has no journal")));
    goOn(folder());
    expectRefused("it was completed");
}

TEST_F(ResumeRefused, WhenTheOrderIsAnother) {
    study.protocol.ordering.scheme = OrderScheme::listed;
    expectRefused("the design has changed");
}

TEST_F(ResumeRefused, WhenALineIsDamaged) {
    const std::string text = readFile(journal());
    std::string damaged = text;
    damaged[damaged.find('\n') + 1] = '#';
    writeFile(journal(), damaged);
    expectRefused(":2: expected an entry as this program writes it");
    std::string gap = text;
    const std::size_t line = gap.find("{\"event\":\"trial_started\"");
    writeFile(journal(), gap.erase(line, gap.find('\n', line) + 1 - line));
    expectRefused(":2: expected an entry as this program writes it");
    writeFile(journal(), text + "{\"event\":\"trial_st");
    EXPECT_EQ(brokenSession(study, folder(), session).trials, 3) << "a torn line was never read";
}

// The slot was given back, and another participant has it.
TEST_F(ResumeRefused, WhenItsSlotIsAnothers) {
    const DataFolder data = folder();
    Ledger(data.ledger()).giveBack(1);
    const BrokenSession broken = brokenSession(study, data, session);
    ASSERT_EQ(Ledger(data.ledger()).claim({"S2", 1, true}), 1);
    Mortal observer = mortal();
    const std::string before = readFile(journal());
    EXPECT_THAT([&] { resumeSession(study, data, broken, observer); },
                ThrowsMessage<Error>(HasSubstr("is that of participant S2 now")));
    EXPECT_EQ(readFile(journal()), before);
    EXPECT_THAT(observer.seen, IsEmpty());
}

TEST_F(ResumeRefused, WhileItRuns) {
    const DataFolder data = folder();
    const BrokenSession broken = brokenSession(study, data, session);
    Ledger ledger(data.ledger());
    const SlotClaim claim(ledger, 1, session); // by this process
    Mortal observer = mortal();
    EXPECT_THAT([&] { resumeSession(study, data, broken, observer); },
                ThrowsMessage<Error>(HasSubstr("slot 1 is in use")));
}

TEST_F(ResumeRefused, ButASlotGivenBackIsTakenAgain) {
    Ledger(folder().ledger()).giveBack(1);
    EXPECT_EQ(goOn(folder()).size(), 4u);
    EXPECT_EQ(Ledger(folder().ledger()).records().at(0).state, SlotState::completed);
}

// A real participant beyond the plan is one too many; a slot given back is not.
TEST(Quota, ThePlanIsNotExceeded) {
    const test::TemporaryFolder temporary;
    Ledger ledger(temporary.path() / "ledger.jsonl");
    EXPECT_EQ(ledger.claim({"P1"}, "", 2), 1);
    EXPECT_EQ(ledger.claim({"P2"}, "", 2), 2);
    ledger.complete(1);
    EXPECT_THAT([&] { ledger.claim({"P3"}, "", 2); },
                ThrowsMessage<Error>(HasSubstr("all 2 participants that the protocol plans have "
                                               "taken part (1 completed, 1 running")));
    ledger.giveBack(2);
    EXPECT_EQ(ledger.claim({"P3"}, "", 2), 2);
    EXPECT_EQ(ledger.claim({"P4"}, "", 3), 3);
}

} // namespace
} // namespace obscura
