#include "base/error.h"
#include "base/files.h"
#include "experiment/recorder.h"
#include "protocols/reader/trial_tables.h"
#include "tests/experiment/psych_ds.h"
#include "tests/experiment/tiny_study.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::ThrowsMessage;

const std::string digest(64, 'a');

Response row(int trial) {
    Response row;
    row.rowId = "P1-1-" + std::to_string(trial);
    row.studyId = "tiny-study";
    row.participantId = "P1";
    row.sessionId = "1";
    row.slotId = row.squareId = row.squareRow = 1;
    row.trialIndex = trial;
    row.conditionId = row.level = row.scene = row.techniqueA = row.techniqueB = "x";
    row.paramsA = "{\"radius\":0.5,\"samples\":24}";
    row.stimFirst = row.stimSecond = "x.png";
    row.sha256First = row.sha256Second = row.protocolSha256 = row.designSha256 = digest;
    row.firstIs = "a";
    row.maskFramesPlanned = row.maskFramesShown = 120;
    row.refreshHz = 60;
    row.timestampSource = "none";
    row.chosenPosition = 1;
    row.chosenTechnique = "x";
    row.appVersion = row.gitCommit = row.machineId = "x";
    row.wallTimeUtc = "2026-01-31T23:59:59Z";
    return row;
}

// Of a trial: the row, and something for the other tables.
TrialLines lines(int trial) {
    PhaseRow phase;
    phase.trial.rowId = fmt::format("P1-1-{}-first", trial);
    phase.phase = "first";
    AnswerRow answer;
    answer.trial.rowId = fmt::format("P1-1-{}-why", trial);
    answer.value = "darker, \"softer\"\nand calmer";
    return {responseLine(row(trial)), phaseLine(phase), answerLine(answer)};
}

class RecorderTest : public testing::Test {
  protected:
    test::TemporaryFolder temporary;
    DataFolder folder = [&] {
        Protocol protocol;
        protocol.name = "tiny-study";
        protocol.title = "Tiny";
        return DataFolder(temporary.path(), protocol);
    }();
    SessionId session{"P1", 1, false};
    fs::path dataset = temporary.path() / "tiny-study";

    void SetUp() override { folder.prepare(); }
};

TEST_F(RecorderTest, WritesRowsThatReadBack) {
    Recorder recorder(folder, session, 1, true);
    recorder.finished(1, lines(1));
    recorder.finished(2, lines(2));
    const ResponseFile file = readResponses(folder.rows(session), false);
    ASSERT_EQ(file.rows.size(), 2u);
    EXPECT_EQ(file.rows[1].trialIndex, 2);
    EXPECT_EQ(file.rows[0].paramsA, row(1).paramsA);
}

TEST_F(RecorderTest, TheDatasetFollowsPsychDs) {
    Recorder recorder(folder, session, 1, true);
    recorder.finished(1, lines(1));
    recorder.end("completed");
    EXPECT_THAT(test::psychDsFaults(dataset), IsEmpty());
    EXPECT_EQ(folder.rows(session).filename(), "study-tinystudy_subject-P1_session-1_data.csv");
    EXPECT_TRUE(fs::exists(dataset / "README.md"));
}

TEST_F(RecorderTest, TheCheckerFindsFaults) {
    { Recorder recorder(folder, session, 1, true); }
    std::ofstream(dataset / "data" / "P1.csv") << "a,a\n1\n";
    EXPECT_EQ(test::psychDsFaults(dataset).size(), 4u); // name, column twice, columns, length
    fs::remove(dataset / "data" / "P1.csv");
    fs::remove(dataset / "dataset_description.json");
    EXPECT_THAT(test::psychDsFaults(dataset), Not(IsEmpty()));
}

TEST_F(RecorderTest, NeverOverwrites) {
    {
        Recorder recorder(folder, session, 1, true);
        recorder.finished(1, lines(1));
    }
    const std::string before = readFile(folder.rows(session));
    EXPECT_THAT([&] { Recorder(folder, session, 2, true); },
                ThrowsMessage<Error>(HasSubstr("expected to create a new file")));
    EXPECT_EQ(readFile(folder.rows(session)), before);
    EXPECT_THAT(objection(folder, session), HasSubstr("there are data of P1, session 1"));
    EXPECT_EQ(objection(folder, {"P1", 2, false}), "");
    EXPECT_THAT(objection(folder, {"p1", 1, false}), HasSubstr("in other letters"));
}

TEST_F(RecorderTest, JournalsEachStepBeforeReturning) {
    Recorder recorder(folder, session, 3, true);
    recorder.trialStarted(1, "c5");
    std::string journal = readFile(folder.journal(session));
    EXPECT_THAT(journal, HasSubstr("session_started"));
    EXPECT_THAT(journal, HasSubstr("\"trial\":1,\"condition\":\"c5\""));
    EXPECT_THAT(journal, Not(HasSubstr("session_ended")));
    recorder.end("completed");
    journal = readFile(folder.journal(session));
    EXPECT_THAT(journal, HasSubstr("\"reason\":\"completed\""));
}

// What a process had recorded is there after SIGKILL, to the byte.
TEST_F(RecorderTest, KilledProcessLosesNoRow) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        Recorder recorder(folder, session, 1, true);
        for (int trial = 1; trial <= 3; ++trial)
            recorder.finished(trial, lines(trial));
        recorder.trialStarted(4, "c4");
        EXPECT_EQ(::write(ready[1], "r", 1), 1);
        ::pause();
    }
    char byte;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(readFile(folder.rows(session)), responseHeader() + responseLine(row(1)) +
                                                  responseLine(row(2)) + responseLine(row(3)));
    EXPECT_THAT(readFile(folder.journal(session)), HasSubstr("\"trial\":4"));
}

// Whatever a crash keeps from the tables, the journal has: cut anywhere (at every 13th byte here,
// for each time is several of the disk's own), each is whole again.
TEST_F(RecorderTest, TablesAreRestoredFromTheJournalByteForByte) {
    {
        Recorder recorder(folder, session, 1, true);
        for (int trial = 1; trial <= 2; ++trial)
            recorder.finished(trial, lines(trial));
    }
    EXPECT_EQ(restoreTables(folder, session), 0);
    for (const fs::path& path :
         {folder.rows(session), folder.phases(session), folder.answers(session)}) {
        const std::string whole = readFile(path);
        for (std::size_t cut = whole.find('\n') + 1; cut < whole.size(); cut += 13) {
            std::ofstream(path, std::ios::trunc) << whole.substr(0, cut);
            restoreTables(folder, session);
            ASSERT_EQ(readFile(path), whole) << path << " cut at " << cut;
        }
        fs::remove(path);
        EXPECT_EQ(restoreTables(folder, session), 1);
        EXPECT_EQ(readFile(path), whole);
    }
}

// A full disk, played by a limit on the size of files: the row that does not fit leaves no trace in
// the file, and stands in the error.
TEST_F(RecorderTest, ARowThatDoesNotFitLeavesNoHalfLine) {
    const std::size_t whole = responseHeader().size() + responseLine(row(1)).size();
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{whole + 100, whole + 100};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        Recorder recorder(folder, session, 1, true);
        recorder.finished(1, lines(1));
        try {
            recorder.finished(2, lines(2));
        } catch (const Error& error) {
            ::_exit(std::string(error.what()).find("P1-1-2") != std::string::npos ? 0 : 2);
        }
        ::_exit(1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(readFile(folder.rows(session)), responseHeader() + responseLine(row(1)));
}

// Killed, or stopped by a full disk, between making a file and writing its header.
TEST_F(RecorderTest, NoFileIsThereWithoutItsHeader) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{10, 10};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            Recorder recorder(folder, session, 1, true);
        } catch (const Error&) {
            ::_exit(0);
        }
        ::_exit(1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_FALSE(fs::exists(folder.rows(session)));
    EXPECT_THAT(objection(folder, session), "");
}

TEST_F(RecorderTest, ADescriptionOfAnEarlierVersionGainsTheNewColumns) {
    const fs::path path = dataset / "dataset_description.json";
    auto json = nlohmann::ordered_json::parse(readFile(path));
    json["author"] = "A. Person";
    auto& variables = json["variableMeasured"];
    variables.erase(variables.size() - 1);
    variables.erase(variables.size() - 1);
    writeFile(path, json.dump());
    folder.prepare();
    const auto now = nlohmann::ordered_json::parse(readFile(path));
    EXPECT_EQ(now["author"], "A. Person");
    EXPECT_EQ(now["variableMeasured"].size(), responseColumns().size());
}

TEST_F(RecorderTest, ADescriptionOfOtherColumnsIsRefused) {
    const fs::path path = dataset / "dataset_description.json";
    auto json = nlohmann::ordered_json::parse(readFile(path));
    json["author"] = "A. Person"; // users may add to it
    writeFile(path, json.dump());
    EXPECT_NO_THROW(folder.prepare());
    json["variableMeasured"].erase(0);
    writeFile(path, json.dump());
    EXPECT_THAT([&] { folder.prepare(); },
                ThrowsMessage<Error>(HasSubstr("the columns described are not those")));
}

TEST_F(RecorderTest, ObjectsToIdsThatAreNotLettersAndDigits) {
    for (const char* id : {"", "P-1", "P 1", "P_1", "Søren", "a/b", "..", "p.1"})
        EXPECT_THAT(objection(folder, {id, 1, false}), HasSubstr("letters (a-z) and digits")) << id;
    EXPECT_NE(objection(folder, {std::string(33, 'a'), 1, false}), "");
    EXPECT_EQ(objection(folder, {"P01", 1, false}), "");
}

} // namespace
} // namespace obscura
