#include "base/error.h"
#include "base/files.h"
#include "experiment/session.h"
#include "experiment/signals.h"
#include "experiment/simulated.h"
#include "protocols/reader/responses.h"
#include "tests/experiment/psych_ds.h"
#include "tests/experiment/tiny_study.h"
#include "tests/experiment/trial_bench.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

// Runs S01 ... of a study into a data folder; all rows.
std::vector<Response> simulate(const Study& study, const fs::path& data, int participants,
                               std::uint64_t seed) {
    const DataFolder folder(data, study.protocol);
    std::vector<Response> rows;
    for (int i = 1; i <= participants; ++i) {
        const SessionId session{fmt::format("S{:02}", i), 1, true};
        SimulatedObserver observer(study.protocol, seed, session.participant);
        EXPECT_TRUE(runSession(study, folder, session, observer));
        for (const Response& row : readResponses(folder.rows(session), false).rows)
            rows.push_back(row);
    }
    return rows;
}

// Without what the wall clock decides.
std::string timeless(std::vector<Response> rows) {
    std::string text;
    for (Response& row : rows) {
        row.wallTimeUtc = "2026-01-31T23:59:59Z";
        text += responseLine(row);
    }
    return text;
}

class SimulationTest : public testing::Test {
  protected:
    test::TemporaryFolder folder;

    Study study(const test::TinyOptions& options = {}) {
        const test::TinyStudy tiny = test::writeTinyStudy(folder.path(), options);
        return openStudy(tiny.protocol, tiny.stimuli);
    }
};

TEST_F(SimulationTest, SameSeedSameRows) {
    const Study tiny = study();
    const std::string one = timeless(simulate(tiny, folder.path() / "one", 5, 42));
    const std::string again = timeless(simulate(tiny, folder.path() / "again", 5, 42));
    const std::string other = timeless(simulate(tiny, folder.path() / "other", 5, 43));
    EXPECT_EQ(one, again);
    EXPECT_NE(one, other);
}

TEST_F(SimulationTest, LooksNoShorterThanTheMinimumView) {
    const Study tiny = study({.minimumView = 5});
    const auto rows = simulate(tiny, folder.path() / "data", 3, 1);
    for (const Response& row : rows) {
        EXPECT_GE(row.view1Ms, 5000);
        EXPECT_GE(row.view2Ms, 5000);
    }
    const DataFolder data(folder.path() / "data", tiny.protocol);
    for (const char* id : {"S01", "S02", "S03"})
        EXPECT_THAT(readFile(data.journal({id, 1, true})),
                    testing::Not(HasSubstr("presses_ignored")))
            << "nor presses in vain";
}

TEST_F(SimulationTest, RowsAreWholeAndMarked) {
    const auto rows = simulate(study({.mask = 2}), folder.path() / "data", 8, 1);
    ASSERT_EQ(rows.size(), 56u);
    for (const Response& row : rows) {
        EXPECT_TRUE(row.simulated);
        EXPECT_EQ(row.timestampSource, "none");
        EXPECT_EQ(row.maskFramesPlanned, 120);
        EXPECT_EQ(row.maskFramesShown, 120);
        EXPECT_EQ(row.missedFrames, 0);
        EXPECT_NEAR(row.maskMs, 2000, 1e-3);
        EXPECT_FALSE(row.interrupted);
        EXPECT_GT(row.view1Ms, 150);
        EXPECT_GT(row.decisionRtMs, 149);
        EXPECT_EQ(row.firstIs == "b", row.pairsReversed);
        EXPECT_EQ(row.pairsReversed, row.slotId > 7);
        EXPECT_EQ(row.techniqueA, "none");
        EXPECT_EQ(row.techniqueB, "crytek24");
        EXPECT_EQ(row.stimFirst, row.conditionId + (row.firstIs == "a" ? "_a.png" : "_b.png"));
        EXPECT_EQ(row.sha256First, sha256File(folder.path() / "stimuli" / row.stimFirst));
        EXPECT_EQ(row.paramsA, "{\"radius\":0.5}");
        EXPECT_EQ(row.paramsB, "{\"radius\":0.5,\"samples\":24.0}");
    }
    EXPECT_THAT(test::psychDsFaults(folder.path() / "data" / "tiny-study"), IsEmpty());
}

// Everything that comes between main trials, and repeats, in the rows; of breaks there are none.
TEST_F(SimulationTest, KindsAndRepeatsAreInTheRows) {
    const Study tiny = study({.ordering = "scheme = \"williams\"\nrepeats = 2\nbreakEvery = 3\n"
                                          "practice = [\"c6\"]\ncatch = [\"c7\"]\ncatchEvery = 5"});
    const auto rows = simulate(tiny, folder.path() / "data", 1, 1);
    std::string kinds, repeats;
    std::vector<std::string> order;
    for (const Response& row : rows) {
        kinds += row.trialKind[0];
        repeats += std::to_string(row.repeatIndex);
        order.push_back(row.conditionId);
        EXPECT_EQ(row.trialIndex, static_cast<int>(order.size()));
    }
    EXPECT_EQ(kinds, "pmmmmmcmmmmm");
    EXPECT_EQ(repeats, "111111122222");
    EXPECT_EQ(order.at(0), "c6");
    EXPECT_EQ(order.at(6), "c7");
    for (std::size_t i = 1; i <= 5; ++i) {
        const auto again = std::find(order.begin() + 7, order.end(), order[i]);
        ASSERT_NE(again, order.end());
        EXPECT_NE(rows[i].firstIs, rows[static_cast<std::size_t>(again - order.begin())].firstIs);
    }
    const DataFolder data(folder.path() / "data", tiny.protocol);
    const auto sidecar = nlohmann::json::parse(readFile(data.sidecar({"S01", 1, true})));
    EXPECT_EQ(sidecar["order"].get<std::vector<std::string>>(), order);
    EXPECT_THAT(test::psychDsFaults(folder.path() / "data" / "tiny-study"), IsEmpty());
}

// Condition c7 is always answered right, c3 mostly wrong: who climbs to c3 is led back.
TEST_F(SimulationTest, StaircasesFollowTheAnswersInTheRows) {
    const Study tiny = study({.ordering = "scheme = \"staircase\"\nreversals = 4\ntrials = 40",
                              .conditions = "correct = \"b\""});
    const auto rows = simulate(tiny, folder.path() / "data", 4, 1);
    std::map<std::string, std::vector<Response>> sessions;
    for (const Response& row : rows)
        sessions[row.participantId].push_back(row);
    ASSERT_EQ(sessions.size(), 4u);
    for (const auto& [id, session] : sessions) {
        int level = 0, right = 0;
        for (const Response& row : session) {
            EXPECT_EQ(row.conditionId, fmt::format("c{}", level + 1)) << id;
            right = row.choseB ? right + 1 : 0;
            if (!row.choseB)
                level = std::max(level - 1, 0);
            if (right == 2) {
                level = std::min(level + 1, 6);
                right = 0;
            }
        }
        EXPECT_GT(session.size(), 7u);
        EXPECT_LE(session.size(), 40u);
    }
}

// Share of b per condition within 4.5 standard errors of the stated model; with seven conditions a
// sound program fails once in 20 000 seeds, and the seed is fixed.
TEST_F(SimulationTest, ChoicesFollowTheModel) {
    constexpr int participants = 112;
    constexpr double bias = 0.1;
    const auto rows =
        simulate(study({.positionBias = bias}), folder.path() / "data", participants, 7);
    for (std::size_t c = 0; c < test::tinyPreferences().size(); ++c) {
        const double p = test::tinyPreferences()[c];
        // Half of the slots show b second, half show it first.
        const double shareB = 0.5 * (std::min(p + bias, 1.0) + 1 - std::min(1 - p + bias, 1.0));
        const auto chosen = std::count_if(rows.begin(), rows.end(), [&](const Response& row) {
            return row.conditionId == fmt::format("c{}", c + 1) && row.choseB;
        });
        EXPECT_NEAR(static_cast<double>(chosen) / participants, shareB,
                    4.5 * 0.5 / std::sqrt(participants))
            << "condition " << c + 1;
    }
    const auto second = std::count_if(rows.begin(), rows.end(),
                                      [](const Response& row) { return row.chosenPosition == 2; });
    double expected = 0;
    for (const double p : test::tinyPreferences())
        expected += 0.5 * (std::min(p + bias, 1.0) + std::min(1 - p + bias, 1.0));
    const auto trials = static_cast<double>(rows.size());
    EXPECT_NEAR(static_cast<double>(second) / trials, expected / 7, 4.5 * 0.5 / std::sqrt(trials));
}

TEST_F(SimulationTest, TimesFollowTheExGaussian) {
    const auto rows = simulate(study(), folder.path() / "data", 42, 3);
    double sum = 0;
    for (const Response& row : rows)
        sum += row.decisionRtMs / 1000;
    const double mean = sum / static_cast<double>(rows.size());
    const double error = std::sqrt((0.2 * 0.2 + 0.5 * 0.5) / static_cast<double>(rows.size()));
    EXPECT_NEAR(mean, 0.9 + 0.5, 4.5 * error); // the protocol's defaults
}

// Every time of a row in the same unit, to the microsecond, and nothing between the phases of a
// trial.
TEST_F(SimulationTest, TimesAddUp) {
    for (const Response& row : simulate(study(), folder.path() / "data", 2, 4)) {
        EXPECT_NEAR(row.onset1Ms + row.view1Ms + row.maskMs, row.onset2Ms, 0.01);
        EXPECT_NEAR(row.onset2Ms + row.view2Ms, row.questionOnsetMs, 0.01);
    }
}

TEST_F(SimulationTest, SidecarSaysHowItWent) {
    const Study tiny = study();
    simulate(tiny, folder.path() / "data", 2, 9);
    const DataFolder data(folder.path() / "data", tiny.protocol);
    const auto sidecar = nlohmann::json::parse(readFile(data.sidecar({"S02", 1, true})));
    EXPECT_EQ(sidecar["slot"], 2);
    EXPECT_EQ(sidecar["order"],
              (std::vector<std::string>{"c2", "c3", "c4", "c5", "c6", "c7", "c1"}));
    EXPECT_EQ(sidecar["end_reason"], "completed");
    EXPECT_EQ(sidecar["model"]["seed"], 9);
    EXPECT_EQ(sidecar["mask_intervals"]["count"], 7 * 18);
}

// Answers two trials, then leaves.
class Quitter : public SimulatedObserver {
  public:
    using SimulatedObserver::SimulatedObserver;

    void prepare(const Upcoming& trial) override {
        trial_ = trial.index;
        SimulatedObserver::prepare(trial);
    }
    std::vector<Event> events(bool wait) override {
        if (!wait || trial_ < 3)
            return SimulatedObserver::events(wait);
        return {{Event::Kind::press, 1e6, pressed_++ ? gl::Key::two : gl::Key::escape}};
    }

  private:
    int trial_ = 0, pressed_ = 0;
};

TEST_F(SimulationTest, LeavingKeepsTheRowsAndReturnsTheSlot) {
    const Study tiny = study();
    const DataFolder data(folder.path() / "data", tiny.protocol);
    const SessionId session{"S01", 1, true};
    Quitter quitter(tiny.protocol, 1, "S01");
    EXPECT_FALSE(runSession(tiny, data, session, quitter));
    EXPECT_EQ(readResponses(data.rows(session), false).rows.size(), 2u);
    EXPECT_EQ(Ledger(data.ledger()).records().front().state, SlotState::returned);
    EXPECT_THAT(readFile(data.journal(session)), HasSubstr("left before the last trial"));

    const SessionId next{"S02", 1, true};
    SimulatedObserver observer(tiny.protocol, 1, "S02");
    EXPECT_TRUE(runSession(tiny, data, next, observer));
    EXPECT_EQ(readResponses(data.rows(next), false).rows.front().slotId, 1);
}

TEST_F(SimulationTest, ARehearsalTakesNoSlotAndSaysSo) {
    const Study tiny = study();
    const DataFolder rehearsals(folder.path() / "data", tiny.protocol, true);
    const SessionId rehearsal{"S01", 1, false, true}, real{"S01", 1, true};
    SimulatedObserver observer(tiny.protocol, 1, "S01");
    EXPECT_TRUE(runSession(tiny, rehearsals, rehearsal, observer));
    const auto rows = readResponses(rehearsals.rows(rehearsal), false).rows;
    ASSERT_EQ(rows.size(), 7u);
    for (const Response& row : rows)
        EXPECT_TRUE(row.rehearsal);
    EXPECT_FALSE(fs::exists(rehearsals.ledger()));
    EXPECT_FALSE(fs::exists(folder.path() / "data" / "tiny-study"));
    EXPECT_THAT(test::psychDsFaults(rehearsals.path()), IsEmpty());

    // The same person for good: the first slot, and no rehearsal.
    const DataFolder data(folder.path() / "data", tiny.protocol);
    EXPECT_EQ(objection(data, real), "");
    EXPECT_TRUE(runSession(tiny, data, real, observer));
    EXPECT_FALSE(readResponses(data.rows(real), false).rows.front().rehearsal);
    EXPECT_EQ(Ledger(data.ledger()).records().front().slot, 1);
    EXPECT_THAT(test::psychDsFaults(data.path()), IsEmpty());
}

// Is sent a signal while image 2 of the third pair is on view.
class Interrupted : public SimulatedObserver {
  public:
    using SimulatedObserver::SimulatedObserver;

    void prepare(const Upcoming& trial) override {
        trial_ = trial.index;
        SimulatedObserver::prepare(trial);
    }
    double show(const TrialMachine& trial) override {
        if (trial_ == 3 && trial.screen() == test::secondImage)
            ::raise(SIGTERM);
        return SimulatedObserver::show(trial);
    }

  private:
    int trial_ = 0;
};

TEST_F(SimulationTest, ASignalEndsTheSessionAsLeavingDoes) {
    const Study tiny = study();
    const DataFolder data(folder.path() / "data", tiny.protocol);
    const SessionId session{"S01", 1, true};
    const pid_t child = ::fork(); // for a noted signal stays noted
    if (child == 0) {
        heedSignals();
        Interrupted observer(tiny.protocol, 1, "S01");
        try {
            runSession(tiny, data, session, observer);
        } catch (const EndedBySignal& ended) {
            ::_exit(ended.exitStatus());
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 128 + SIGTERM);
    EXPECT_EQ(readResponses(data.rows(session), false).rows.size(), 2u);
    EXPECT_EQ(Ledger(data.ledger()).records().front().state, SlotState::returned);
    EXPECT_THAT(readFile(data.journal(session)), HasSubstr("\"reason\":\"ended by SIGTERM\""));
    EXPECT_EQ(nlohmann::json::parse(readFile(data.sidecar(session)))["end_reason"],
              "ended by SIGTERM");
}

// No terminal to ask on: refused without --yes. A slot that is in doubt is one completed, or one of
// another machine.
TEST_F(SimulationTest, VoidingACompletedSlotNeedsAWord) {
    const Study tiny = study();
    const DataFolder data(folder.path() / "data", tiny.protocol);
    SimulatedObserver observer(tiny.protocol, 1, "S01");
    ASSERT_TRUE(runSession(tiny, data, {"S01", 1, true}, observer));
    const fs::path output = folder.path() / "output.txt";
    const auto ledger = [&](const std::string& more) {
        return std::system(fmt::format("'{}/obscura-experiment' ledger --protocol '{}' --data '{}' "
                                       "--void 1 {} >'{}' 2>&1 </dev/null",
                                       OBSCURA_BIN, tiny.protocol.path.string(),
                                       (folder.path() / "data").string(), more, output.string())
                               .c_str());
    };
    EXPECT_NE(ledger(""), 0);
    EXPECT_THAT(readFile(output), AllOf(HasSubstr("slot 1 is that of participant S01, session 1, "
                                                  "who has completed it"),
                                        HasSubstr("with --yes if you are sure")));
    EXPECT_EQ(Ledger(data.ledger()).records().front().state, SlotState::completed);
    EXPECT_EQ(ledger("--yes"), 0);
    EXPECT_EQ(Ledger(data.ledger()).records().front().state, SlotState::returned);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST_F(SimulationTest, StimuliServeAProtocolWhoseTextsOrTrialWereMended) {
    const test::TinyStudy tiny = test::writeTinyStudy(folder.path());
    const std::string text = readFile(tiny.protocol);
    for (const auto& [from, to] : {std::pair("Press Space.", "Please press Space."),
                                   std::pair("mask = 0.3", "mask = 0.4")}) {
        writeFile(tiny.protocol, "# a remark\n" + replaced(text, from, to));
        EXPECT_NO_THROW(openStudy(tiny.protocol, tiny.stimuli)) << from;
    }
}

// As versions before had it, which knew the file's hash only.
TEST_F(SimulationTest, StimuliOfAnEarlierVersionServeTheSameFile) {
    const test::TinyStudy tiny = test::writeTinyStudy(folder.path());
    Manifest manifest = readManifest(tiny.stimuli / "manifest.json");
    manifest.stimuliSha256.clear();
    writeManifest(tiny.stimuli / "manifest.json", manifest);
    EXPECT_NO_THROW(openStudy(tiny.protocol, tiny.stimuli));
    std::ofstream(tiny.protocol, std::ios::app) << "# a remark\n";
    EXPECT_THROW(openStudy(tiny.protocol, tiny.stimuli), Error);
}

TEST_F(SimulationTest, AnotherProtocolThanTheStimuliWereMadeFromIsRefused) {
    const test::TinyStudy tiny = test::writeTinyStudy(folder.path());
    writeFile(tiny.protocol, replaced(readFile(tiny.protocol), "samples = 24", "samples = 25"));
    EXPECT_THAT([&] { openStudy(tiny.protocol, tiny.stimuli); },
                ThrowsMessage<Error>(AllOf(HasSubstr("made from another version of"),
                                           HasSubstr("make them: obscura-stimuli"))));
}

TEST_F(SimulationTest, AChangedImageIsRefused) {
    const Study tiny = study();
    EXPECT_NO_THROW(verifyStimuli(tiny.manifest));
    std::ofstream(folder.path() / "stimuli" / "c3_b.png", std::ios::app) << "x";
    EXPECT_THAT([&] { verifyStimuli(tiny.manifest); },
                ThrowsMessage<Error>(AllOf(HasSubstr("c3_b.png: not the image"),
                                           HasSubstr("run obscura-stimuli again"))));
    EXPECT_THROW(loadStimulus(tiny.manifest, tiny.condition(2).image("b")), Error);
    EXPECT_NO_THROW(loadStimulus(tiny.manifest, tiny.condition(2).image("a")));
}

TEST_F(SimulationTest, AFolderWithoutStimuliIsRefused) {
    const test::TinyStudy tiny = test::writeTinyStudy(folder.path());
    EXPECT_THAT([&] { openStudy(tiny.protocol, folder.path()); },
                ThrowsMessage<Error>(HasSubstr("found no manifest.json in it; make them: ")));
}

TEST_F(SimulationTest, AMissingPairIsRefused) {
    const test::TinyStudy tiny = test::writeTinyStudy(folder.path());
    Manifest manifest = readManifest(tiny.stimuli / "manifest.json");
    manifest.conditions.pop_back();
    writeManifest(tiny.stimuli / "manifest.json", manifest);
    EXPECT_THAT([&] { openStudy(tiny.protocol, tiny.stimuli); },
                ThrowsMessage<Error>(HasSubstr("expected the images of condition \"c7\"")));
}

TEST(SimulatedObserverTest, TypesANumberThatANarrowRangeTakes) {
    Question share;
    share.name = "share";
    share.kind = Question::Kind::number;
    share.least = 0.1, share.most = 0.4;
    Phase phase;
    phase.name = "ask";
    phase.questions = {share};
    const Protocol protocol;
    SimulatedObserver observer(protocol, 1, "S01");
    TrialMachine machine({phase}, 2, 60);
    machine.journalled();
    for (int i = 0; i < 10 && machine.next() != TrialMachine::Next::finished; ++i) {
        if (machine.next() == TrialMachine::Next::present)
            machine.shown(observer.show(machine));
        for (const Event& event : observer.events(true))
            machine.handle(event);
    }
    ASSERT_EQ(machine.next(), TrialMachine::Next::finished);
    EXPECT_EQ(machine.record().answers[0].value, "0.25");
}

} // namespace
} // namespace obscura
