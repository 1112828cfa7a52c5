#include "analysis/answers.h"
#include "tests/analysis/sample_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using test::errorOf;
using test::sampleResponse;
using test::writeRows;
using testing::HasSubstr;

class CollectAnswers : public testing::Test {
  protected:
    Answers collect(const AnswerRules& rules = {}) {
        return collectAnswers(std::vector{folder_.path()}, rules);
    }

    std::string error() {
        return errorOf([&] { collect(); });
    }

    // "<folder>/a.csv" as errors name it.
    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    test::Folder folder_;
};

TEST_F(CollectAnswers, ReadsADataFolderInTheOrderOfFileNames) {
    test::writeStudy(folder_.path(), 3);
    writeFile(folder_ / "data/.unfinished.csv", "not yet");
    writeFile(folder_ / "data/README.md", "not data");
    const Answers answers = collect();
    ASSERT_EQ(answers.counted.size(), 6u);
    EXPECT_EQ(answers.files, 3);
    EXPECT_EQ(answers.counted[5].row.participantId.text(), "P03");
    EXPECT_EQ(answers.counted[5].line, 3);
}

TEST_F(CollectAnswers, TakesAFileOnceHoweverItIsGiven) {
    const auto study = test::writeStudy(folder_.path(), 2);
    const auto file = study / "data" / "study-sample_subject-P01_session-1_data.csv";
    EXPECT_EQ(collectAnswers(std::vector{file, study, study / "data"}, {}).counted.size(), 4u);
}

TEST_F(CollectAnswers, SaysWhatIsMissing) {
    EXPECT_EQ(errorOf([] { collectAnswers(std::vector<std::filesystem::path>{"/none"}, {}); }),
              "/none: expected a study's folder or a CSV file, found nothing of this name");
    EXPECT_EQ(error(), folder_.path().string() + ": expected CSV files of responses, found none");
    writeRows(folder_ / "a.csv", {});
    EXPECT_EQ(error(), "expected answers to main trials, found none in 1 file(s)");
}

TEST_F(CollectAnswers, RefusesSimulatedRowsAmongRealOnes) {
    Response simulated = sampleResponse(2, "c1", true);
    simulated.simulated = true;
    writeRows(folder_ / "a.csv", {sampleResponse(1, "c1", true)});
    writeRows(folder_ / "b.csv", {sampleResponse(3, "c1", true), simulated});
    EXPECT_EQ(error(), file("b.csv") + ":3: simulated: a simulated row among real ones (" +
                           file("a.csv") +
                           ":2); --simulated exclude leaves such rows out, only "
                           "counts nothing else, include pools them");

    const Answers real = collect({.simulated = SimulatedRows::exclude});
    EXPECT_EQ(real.counted.size(), 2u);
    EXPECT_EQ(real.leftOut.simulated, 1);
    const Answers only = collect({.simulated = SimulatedRows::only});
    EXPECT_EQ(only.counted.size(), 1u);
    EXPECT_EQ(only.leftOut.real, 2);
    EXPECT_EQ(collect({.simulated = SimulatedRows::include}).counted.size(), 3u);
}

TEST_F(CollectAnswers, AcceptsDataThatAreAllSimulated) {
    test::writeStudy(folder_.path(), 2, true);
    EXPECT_EQ(collect().counted.size(), 4u);
}

TEST_F(CollectAnswers, RefusesMixedStudies) {
    Response other = sampleResponse(1, "c1", true);
    other.studyId = "another";
    other.protocolSha256 = std::string(64, '1');
    writeRows(folder_ / "a.csv", {sampleResponse(1, "c1", true)});
    writeRows(folder_ / "b.csv", {other});
    EXPECT_EQ(error(), file("b.csv") + ":2: study_id: expected \"sample\" as in " + file("a.csv") +
                           ":2, found \"another\"; --allow-mixed-studies pools them");
    EXPECT_EQ(collect({.mixedStudies = true}).counted.size(), 2u);
}

TEST_F(CollectAnswers, RefusesMixedDesignsOfOneStudy) {
    Response later = sampleResponse(2, "c1", true);
    later.protocolSha256 = std::string(64, '1');
    later.designSha256 = std::string(64, '2');
    writeRows(folder_ / "a.csv", {sampleResponse(1, "c1", true), later});
    const std::string expected =
        fmt::format("{0}:3: design_sha256: a design of study \"sample\" other than in {0}:2 "
                    "(protocol 111111111111..., not 000000000000...); --allow-mixed-protocols "
                    "pools them",
                    file("a.csv"));
    EXPECT_EQ(error(), expected);
    EXPECT_EQ(errorOf([&] { collect({.mixedStudies = true}); }), expected);
    EXPECT_EQ(collect({.mixedProtocols = true}).counted.size(), 2u);
}

TEST_F(CollectAnswers, AMendedTextIsNoOtherDesign) {
    Response later = sampleResponse(2, "c1", true);
    later.protocolSha256 = std::string(64, '1');
    writeRows(folder_ / "a.csv", {sampleResponse(1, "c1", true), later});
    EXPECT_EQ(collect().counted.size(), 2u);
}

// The columns of version 2 are the last two.
TEST_F(CollectAnswers, TakesFilesOfAnEarlierVersionForTheStudys) {
    const auto without = [](std::string line) {
        line.resize(line.rfind(',', line.rfind(',') - 1));
        return line + "\n";
    };
    Response old = sampleResponse(1, "c1", true);
    old.schemaVersion = 1;
    writeFile(folder_ / "a.csv", without(responseHeader()) + without(responseLine(old)));
    Response later = sampleResponse(3, "c1", true);
    later.protocolSha256 = std::string(64, '1');
    writeRows(folder_ / "b.csv", {sampleResponse(2, "c1", true), later});
    const Answers answers = collect();
    EXPECT_EQ(answers.counted.size(), 3u);
    EXPECT_EQ(answers.earlierFiles, 1);

    Response other = sampleResponse(4, "c1", true);
    other.protocolSha256 = other.designSha256 = std::string(64, '4');
    writeRows(folder_ / "b.csv", {other});
    EXPECT_THAT(error(), HasSubstr("other than in"));
}

TEST_F(CollectAnswers, NeverCountsRehearsals) {
    Response rehearsed = sampleResponse(2, "c1", true);
    rehearsed.rehearsal = true;
    writeRows(folder_ / "a.csv", {sampleResponse(1, "c1", true)});
    writeRows(folder_ / "b.csv", {rehearsed});
    const Answers answers = collect();
    EXPECT_EQ(answers.counted.size(), 1u);
    EXPECT_EQ(answers.leftOut.rehearsed, 1);
    std::filesystem::remove(folder_ / "a.csv");
    EXPECT_THAT(error(), HasSubstr("found rehearsals only: 1 rows"));
}

TEST_F(CollectAnswers, RefusesARowReadTwice) {
    writeRows(folder_ / "a.csv", {sampleResponse(1, "c1", true)});
    writeRows(folder_ / "copy of a.csv", {sampleResponse(1, "c1", true)});
    EXPECT_EQ(
        error(),
        file("copy of a.csv") +
            ":2: row_id: sample participant P01 session 1 main condition c1 repeat 1 was answered "
            "before, in " +
            file("a.csv") +
            ":2; --allow-duplicates counts the first of such rows and leaves out "
            "the others");
}

TEST_F(CollectAnswers, RefusesATrialAnsweredTwiceAndCountsTheFirstWhenAllowed) {
    Response again = sampleResponse(1, "c1", false);
    again.rowId = "P01-1-again";
    writeRows(folder_ / "a.csv", {sampleResponse(1, "c1", true), again});
    EXPECT_EQ(error(), file("a.csv") +
                           ":3: condition_id: sample participant P01 session 1 main "
                           "condition c1 repeat 1 was answered before, in " +
                           file("a.csv") +
                           ":2; --allow-duplicates counts the first of such rows and leaves out "
                           "the others");
    const Answers answers = collect({.duplicates = true});
    ASSERT_EQ(answers.counted.size(), 1u);
    EXPECT_TRUE(answers.counted[0].row.choseB);
    EXPECT_EQ(answers.leftOut.duplicates, 1);
}

TEST_F(CollectAnswers, AcceptsRepeatsAndFurtherSessions) {
    Response repeat = sampleResponse(1, "c1", true), session = repeat;
    repeat.rowId = "P01-1-r2";
    repeat.repeatIndex = 2;
    session.rowId = "P01-2-c1";
    session.sessionId = "2";
    writeRows(folder_ / "a.csv", {sampleResponse(1, "c1", true), repeat, session});
    EXPECT_EQ(collect().counted.size(), 3u);
}

TEST_F(CollectAnswers, LeavesOutPracticeAndCatchTrials) {
    Response practice = sampleResponse(1, "p1", true), check = sampleResponse(1, "k1", true);
    practice.trialKind = "practice";
    check.trialKind = "catch";
    writeRows(folder_ / "a.csv", {practice, check, sampleResponse(1, "c1", true)});
    const Answers answers = collect();
    EXPECT_EQ(answers.counted.size(), 1u);
    EXPECT_EQ(answers.leftOut.practice, 1);
    EXPECT_EQ(answers.leftOut.catches, 1);
}

TEST_F(CollectAnswers, CountsInterruptedTrialsUnlessToldNotTo) {
    Response interrupted = sampleResponse(2, "c1", true);
    interrupted.interrupted = true;
    writeRows(folder_ / "a.csv", {sampleResponse(1, "c1", true), interrupted});
    EXPECT_EQ(collect().counted.size(), 2u);
    const Answers without = collect({.interrupted = false});
    EXPECT_EQ(without.counted.size(), 1u);
    EXPECT_EQ(without.leftOut.interrupted, 1);
}

TEST_F(CollectAnswers, SkipsBadRowsOnlyWhenLenient) {
    Response bad = sampleResponse(2, "c1", true);
    bad.slotId = 0;
    writeRows(folder_ / "a.csv", {sampleResponse(1, "c1", true), bad});
    writeFile(folder_ / "b.csv", responseHeader() + "1,torn");
    EXPECT_EQ(error(), file("a.csv") + ":3:7: slot_id: expected a whole number >= 1, found \"0\"; "
                                       "--lenient skips it");
    const Answers answers = collect({.lenient = true});
    EXPECT_EQ(answers.counted.size(), 1u);
    ASSERT_EQ(answers.bad.size(), 2u);
    EXPECT_EQ(answers.bad[1].place.file, file("b.csv"));
}

// Read in parts of 8 MiB; the rows stand on the lines that they stand on, and so do errors.
TEST_F(CollectAnswers, ALargeFileIsReadAsAWhole) {
    for (const bool isLong : {false, true}) { // settings of one line, or of many
        std::vector<Response> rows;
        for (int number = 1; number <= 200; ++number) {
            rows.push_back(sampleResponse(number, "c1", true));
            rows.back().paramsB = isLong ? "" : std::string(100'000, 'x');
            for (int line = 0; isLong && line < 50'000; ++line)
                rows.back().paramsB += "x\n";
        }
        const int lines = isLong ? 50'001 : 1; // of each row
        writeRows(folder_ / "a.csv", rows);
        const Answers answers = collect();
        ASSERT_EQ(answers.counted.size(), 200u);
        for (int i = 0; i < 200; ++i) {
            ASSERT_EQ(answers.counted[i].row.slotId, i + 1);
            ASSERT_EQ(answers.counted[i].line, 2 + i * lines);
        }
        rows[150].slotId = rows[190].slotId = 0;
        writeRows(folder_ / "a.csv", rows);
        EXPECT_THAT(error(), testing::StartsWith(fmt::format("{}:{}:7: slot_id: expected",
                                                             file("a.csv"), 2 + 150 * lines)));
        const Answers lenient = collect({.lenient = true});
        EXPECT_EQ(lenient.counted.size(), 198u);
        ASSERT_EQ(lenient.bad.size(), 2u);
        EXPECT_EQ(lenient.bad[1].place.line, 2 + 190 * lines);
    }
}

} // namespace
} // namespace obscura
