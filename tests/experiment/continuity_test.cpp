#include "base/error.h"
#include "base/files.h"
#include "experiment/continuity.h"
#include "experiment/session.h"
#include "experiment/simulated.h"
#include "tests/experiment/tiny_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class ContinuityTest : public testing::Test {
  protected:
    test::TemporaryFolder temporary;
    test::TinyStudy tiny = test::writeTinyStudy(temporary.path());
    Study study = openStudy(tiny.protocol, tiny.stimuli);
    DataFolder folder{temporary.path() / "data", study.protocol};

    void run(const std::string& participant) {
        SimulatedObserver observer(study.protocol, 1, participant);
        ASSERT_TRUE(runSession(study, folder, {participant, 1, true}, observer));
    }

    void reopen(const std::string& from, const std::string& to) {
        std::string text = readFile(tiny.protocol);
        writeFile(tiny.protocol, text.replace(text.find(from), from.size(), to));
        study = openStudy(tiny.protocol, tiny.stimuli);
    }

    // Without what version 2 added.
    static void makeOlder(const fs::path& path) {
        std::string text;
        std::istringstream lines(readFile(path));
        for (std::string line; std::getline(lines, line);) {
            auto json = nlohmann::ordered_json::parse(line);
            for (const char* key : {"format_version", "owner", "design_sha256"})
                json.erase(key);
            text += json.dump() + "\n";
        }
        writeFile(path, text);
    }
};

TEST_F(ContinuityTest, TheSameDesignContinues) {
    EXPECT_EQ(checkContinues(folder, study), "");
    EXPECT_FALSE(fs::exists(folder.path())) << "looking writes nothing";
    run("S01");
    EXPECT_EQ(checkContinues(folder, study), "");
    reopen("Thank you.", "Thanks a lot.");
    EXPECT_EQ(checkContinues(folder, study), "");
    run("S02");
}

TEST_F(ContinuityTest, AnotherDesignIsRefusedByName) {
    run("S01");
    reopen("mask = 0.3", "mask = 3\ngrey = 100");
    EXPECT_THAT([&] { checkContinues(folder, study); },
                ThrowsMessage<Error>(AllOf(HasSubstr("tiny.toml: the study's design has changed "
                                                     "since S01 took part: trial.grey was 128, is "
                                                     "now 100; trial.mask was 0.3, is now 3. "),
                                           HasSubstr("another data folder (--data DIR)"))));
    EXPECT_THAT([&] { run("S02"); }, ThrowsMessage<Error>(HasSubstr("for another design")));
}

TEST_F(ContinuityTest, OtherImagesAreAnotherDesign) {
    run("S01");
    study.manifest.conditions[2].image("a").image.sha256 = std::string(64, '7');
    EXPECT_THAT([&] { checkContinues(folder, study); },
                ThrowsMessage<Error>(AllOf(HasSubstr("images.c3.a was \""),
                                           HasSubstr("...\", is now \"777777777777...\""))));
}

// The sidecars alone know the design, too.
TEST_F(ContinuityTest, ADesignIsKnownWithoutItsFileAndFromSidecars) {
    run("S01");
    fs::remove(folder.design());
    makeOlder(folder.ledger());
    EXPECT_EQ(checkContinues(folder, study).find("sessions of an earlier version"),
              folder.path().string().size() + 2);
    reopen("mask = 0.3", "mask = 3");
    EXPECT_THAT([&] { checkContinues(folder, study); },
                ThrowsMessage<Error>(HasSubstr("design has changed since S01 took part: its hash "
                                               "was ")));
}

TEST_F(ContinuityTest, SessionsOfAnEarlierVersionAreTakenAndSaidSo) {
    run("S01");
    fs::remove(folder.design());
    makeOlder(folder.ledger());
    auto sidecar = nlohmann::ordered_json::parse(readFile(folder.sidecar({"S01", 1, true})));
    sidecar.erase("design_sha256");
    writeFile(folder.sidecar({"S01", 1, true}), sidecar.dump());
    EXPECT_THAT(checkContinues(folder, study), HasSubstr("which kept no design"));
    run("S02");
    EXPECT_EQ(Ledger(folder.ledger()).records().back().slot, 2);
}

TEST_F(ContinuityTest, ALostLedgerIsNoticedFromTheSessionsBesideIt) {
    run("S01");
    run("S02");
    const std::string whole = readFile(folder.ledger());
    const auto lost = [&](const std::string& found, const std::string& list) {
        EXPECT_THAT([&] { checkContinues(folder, study); },
                    ThrowsMessage<Error>(
                        AllOf(HasSubstr(found), HasSubstr(list), HasSubstr("ledger --restore"))));
    };
    writeFile(folder.ledger(), "");
    lost("does not know all sessions", "slot 1 (S01, session 1), slot 2 (S02, session 1)");
    fs::remove(folder.ledger());
    lost("the ledger is lost", "slot 1 (S01, session 1), slot 2 (S02, session 1)");
    const std::size_t second = whole.find('\n', whole.find('\n') + 1) + 1;
    writeFile(folder.ledger(), whole.substr(0, second)); // an old copy
    lost("does not know all sessions", "it should have slot 2 (S02, session 1)");

    // Each kind of file is enough.
    fs::remove(folder.ledger());
    fs::remove(folder.sidecar({"S01", 1, true}));
    lost("the ledger is lost", "slot 1 (S01, session 1)");
    fs::remove_all(folder.path() / "sessions");
    lost("the ledger is lost", "slot 1 (S01, session 1)");
}

TEST_F(ContinuityTest, ALostLedgerIsRestoredFromTheSessions) {
    run("S01");
    run("S02");
    run("S03");
    fs::remove(folder.ledger());
    fs::remove(folder.sidecar({"S02", 1, true})); // as if it had been killed before it left a file
    fs::remove(folder.journal({"S02", 1, true}));
    fs::remove(folder.rows({"S02", 1, true}));
    Ledger(folder.ledger()).restore(lostFromLedger(folder));
    const auto records = Ledger(folder.ledger()).records();
    ASSERT_EQ(records.size(), 3u);
    EXPECT_EQ(records[0].state, SlotState::completed);
    EXPECT_EQ(records[1].state, SlotState::returned);
    EXPECT_EQ(records[2].state, SlotState::completed);
    EXPECT_EQ(checkContinues(folder, study), "");
    run("S04");
    EXPECT_EQ(Ledger(folder.ledger()).records()[1].session.participant, "S04");
}

} // namespace
} // namespace obscura
