// obscura-analysis as a person runs it.

#include "base/csv.h"
#include "tests/analysis/sample_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <map>

namespace obscura {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Outcome {
    int status = 0;
    std::string output; // both streams
};

class Program : public testing::Test {
  protected:
    // Arguments are single words of the shell; `environment` stands before the command.
    Outcome run(const std::string& arguments, const std::string& environment = {}) {
        const std::string command =
            fmt::format("{} '{}/obscura-analysis' --out '{}' {} 2>&1", environment, OBSCURA_BIN,
                        out().string(), arguments);
        std::FILE* pipe = ::popen(command.c_str(), "r");
        Outcome outcome;
        char buffer[4096];
        while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe))
            outcome.output.append(buffer, count);
        outcome.status = WEXITSTATUS(::pclose(pipe));
        return outcome;
    }

    std::filesystem::path out() const { return folder_ / "report"; }
    std::string study(bool simulated = false) {
        return "'" + test::writeStudy(folder_ / "study", 28, simulated).string() + "'";
    }

    // votes.csv: column -> value of each row.
    std::map<std::string, std::vector<std::string>> table() const {
        const auto records = splitCsv(readFile(out() / "votes.csv"));
        std::map<std::string, std::vector<std::string>> columns;
        for (std::size_t row = 1; row < records.size(); ++row)
            for (std::size_t i = 0; i < records[row].cells.size(); ++i)
                columns[records[0].cells.at(i)].push_back(records[row].cells[i]);
        return columns;
    }

    test::Folder folder_;
};

// Table 4 of the thesis, which prints p cut to three decimals and chi-square rounded up; R 4.2.2
// has the exact figures.
TEST_F(Program, ReproducesTable4FromThePublishedCounts) {
    const Outcome outcome = run("--counts '" OBSCURA_SOURCE "/analysis/thesis_table4.csv'");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const double chiSquare[] = {0, 1.77777777778, 5.44444444444, 0.444444444444, 5.44444444444, 0,
                                1};
    const double p[] = {1, 0.182422439452, 0.0196306572573, 0.504985075094, 0.0196306572573,
                        1, 0.317310507863};
    const double exact[] = {1, 0.242984954035, 0.0288167196559, 0.61771931703, 0.0288167196559,
                            1, 0.405032246141};
    const auto columns = table();
    ASSERT_EQ(columns.at("condition_id").size(), 7u);
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(columns.at("condition_id")[i], fmt::format("{}", i + 1));
        EXPECT_NEAR(std::stod(columns.at("chi_square")[i]), chiSquare[i], 1e-9);
        EXPECT_NEAR(std::stod(columns.at("p_chi_square")[i]), p[i], 1e-9);
        EXPECT_NEAR(std::stod(columns.at("p_exact")[i]), exact[i], 1e-9);
    }
    EXPECT_THAT(outcome.output, HasSubstr("moderate  sponza      Crytek24   Blizzard24     H2    "
                                          "    11 : 25    69 % (52–84)  5.444   0.020      0.029"));
    EXPECT_THAT(readFile(out() / "report.html"), HasSubstr("thesis_table4.csv"));
}

TEST_F(Program, AnalysesAStudysFolderWithItsStimuli) {
    const auto stimuli = test::writeStimuli(folder_ / "stimuli");
    const Outcome outcome = run(study() + " --stimuli '" + stimuli.string() + "'");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, StartsWith("A sample & its <title>\n"));
    EXPECT_THAT(outcome.output, HasSubstr("28 participants gave 56 votes on 3 conditions."));
    EXPECT_THAT(outcome.output, HasSubstr("report: " + (out() / "report.html").string()));
    const auto columns = table();
    EXPECT_THAT(columns.at("votes_a"), testing::ElementsAre("0", "9", "0"));
    EXPECT_THAT(columns.at("votes_b"), testing::ElementsAre("28", "19", "0"));
    EXPECT_THAT(columns.at("source"), testing::Each("participants"));
}

TEST_F(Program, CautionsFirstWherePositionExplainsChoices) {
    std::vector<Response> rows;
    for (int number = 1; number <= 28; ++number) { // everybody chooses the second image
        rows.push_back(test::sampleResponse(number, "c1", (number - 1) % 14 < 7));
        ASSERT_EQ(rows.back().chosenPosition, 2);
    }
    const auto file = test::writeRows(folder_ / "always2.csv", rows);
    const Outcome outcome = run("'" + file.string() + "'");
    EXPECT_THAT(outcome.output,
                StartsWith("*** CAUTION: position explains choices. The second picture was chosen "
                           "in 28 of 28 votes (100 %; exact two-sided binomial p < 0.001). b was "
                           "chosen, when shown first: 0 % of 14; when shown second: 100 % of 14."));
    EXPECT_THAT(outcome.output, Not(HasSubstr("not balanced")));
    EXPECT_THAT(readFile(out() / "report.html"), HasSubstr("CAUTION: position explains"));
    EXPECT_THAT(table().at("caution"), testing::Each(StartsWith("CAUTION")));
}

TEST_F(Program, CautionsFirstWhereOrderWasNotBalanced) {
    std::vector<Response> rows;
    for (int number = 1; number <= 28; ++number) {
        Response row = test::sampleResponse((number - 1) % 7 + 1, "c1", number % 2);
        row.participantId = fmt::format("P{:02}", number);
        row.rowId = row.participantId + "-1-c1";
        rows.push_back(row);
    }
    const auto file = test::writeRows(folder_ / "unbalanced.csv", rows);
    EXPECT_THAT(run("'" + file.string() + "'").output,
                StartsWith("*** CAUTION: the order of a and b was not balanced, so that a "
                           "preference for a position and one for a picture cannot be told apart "
                           "there: c1 (b second in 28 of 28)."));
}

TEST_F(Program, SaysOfAnEvenSplitOfManyVotesThatNoPreferenceIsNoticeable) {
    const auto file = folder_ / "even.csv";
    writeFile(file, "condition_id,level,scene,tech_a,tech_b,hypothesis,votes_a,votes_b\n"
                    "many,low,dragon,A,B,,500000,500000\n");
    const Outcome outcome = run("--counts '" + file.string() + "'");
    EXPECT_THAT(outcome.output,
                HasSubstr("No noticeable preference: with 1000000 votes, the share of B over A "
                          "(dragon, low) lies from 49.9 to 50.1 % (95 % interval)"));
    EXPECT_THAT(outcome.output, Not(HasSubstr("do not decide")));
}

TEST_F(Program, RefusesOnePersonSpeltTwoWays) {
    std::vector<Response> rows = {test::sampleResponse(1, "c1", true),
                                  test::sampleResponse(2, "c1", true)};
    rows[1].participantId = "p01";
    const auto file = test::writeRows(folder_ / "two.csv", rows);
    EXPECT_THAT(run("'" + file.string() + "'").output,
                HasSubstr("two.csv:3:4: participant_id: expected \"P01\" as in " + file.string() +
                          ":2, found \"p01\""));
}

TEST_F(Program, ReadsItsOwnTableAsCounts) {
    ASSERT_EQ(run(study()).status, 0);
    const auto before = table();
    const auto copy = folder_ / "copy.csv";
    std::filesystem::copy_file(out() / "votes.csv", copy);
    const Outcome outcome = run("--counts '" + copy.string() + "'");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    for (const char* column : {"condition_id", "technique_a", "votes_a", "votes_b", "p_exact"})
        EXPECT_EQ(table().at(column), before.at(column));
}

TEST_F(Program, FollowsTheOrderOfTheStudysDesign) {
    const std::string data = study();
    writeFile(folder_ / "study/sessions/design.json",
              R"({"format_version":1,"design":{"order of conditions":["c2","c1"]}})");
    ASSERT_EQ(run(data).status, 0);
    EXPECT_THAT(table().at("condition_id"), testing::ElementsAre("c2", "c1"));
}

// A claim counts as declared if the design that holds it is the one in the rows.
TEST_F(Program, TestsTheClaimsThatTheDesignDeclares) {
    const std::string claims =
        R"("claims":[{"conditions":["c2"],"family":"","favours":"b",)"
        R"("kind":"superior","margin":0.0,"name":"b is better","scores":[]}])";
    const std::string design = "{" + claims + "}";
    const std::string data = study();
    const auto file = folder_ / "study/sessions/design.json";
    writeFile(file, R"({"format_version":1,"design":)" + design + "}");
    const Outcome other = run(data);
    EXPECT_EQ(other.status, 1);
    EXPECT_THAT(other.output, AllOf(HasSubstr("expected the design under which the answers were"),
                                    HasSubstr("dddddddddddd...")));
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "study/data")) {
        std::string rows = readFile(entry.path());
        const std::string before(64, 'd');
        for (std::size_t at = 0; (at = rows.find(before, at)) != std::string::npos;)
            rows.replace(at, before.size(), sha256(design));
        writeFile(entry.path(), rows);
    }
    const Outcome outcome = run(data);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output,
                HasSubstr("\u201cb is better\u201d: the data support it. The share of b"));
    EXPECT_THAT(outcome.output, HasSubstr("No claim names these conditions, which are "
                                          "exploratory: c1"));
    EXPECT_THAT(readFile(out() / "results.json"), HasSubstr("\"outcome\": \"supported\""));
    // The same of the rows alone, wherever they are named.
    const auto rows = folder_ / "study/data";
    for (const std::string& given :
         {rows.string(), (rows / "study-sample_subject-P01_session-1_data.csv").string()})
        EXPECT_THAT(run("'" + given + "'").output, HasSubstr("\u201cb is better\u201d: the data"));
}

TEST_F(Program, StampsSimulatedData) {
    const Outcome outcome = run(study(true));
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, StartsWith("*** SIMULATED DATA: 56 of 56 votes"));
    EXPECT_THAT(outcome.output, HasSubstr("28 simulated participants gave"));
    EXPECT_THAT(table().at("source"), testing::Each("SIMULATED"));
}

TEST_F(Program, ReportsBadRowsAndSkipsThemWhenLenient) {
    const std::string data = study();
    const auto torn = folder_ / "study/data/study-sample_subject-P29_session-1_data.csv";
    writeFile(torn, responseHeader() + "1,P29");
    const std::string message = torn.string() + ":2: the line has no end: it was cut off while "
                                                "being written";
    const Outcome strict = run(data);
    EXPECT_EQ(strict.status, 1);
    EXPECT_EQ(strict.output, "obscura-analysis: " + message + "; --lenient skips it\n");
    EXPECT_FALSE(std::filesystem::exists(out()));
    const Outcome lenient = run(data + " --lenient");
    EXPECT_EQ(lenient.status, 0);
    EXPECT_THAT(lenient.output, HasSubstr("skipped: " + message + "\n"));
    EXPECT_THAT(readFile(out() / "report.html"), HasSubstr("left out: 1 unreadable"));
}

TEST_F(Program, WritesTheCsvWhereItIsTold) {
    const auto csv = folder_ / "elsewhere/table.csv";
    ASSERT_EQ(run(study() + " --csv '" + csv.string() + "'").status, 0);
    EXPECT_THAT(readFile(csv), StartsWith("source,condition_id,"));
    EXPECT_FALSE(std::filesystem::exists(out() / "votes.csv"));
}

TEST_F(Program, HonoursEveryRule) {
    const std::string data = study();
    Response extra = test::sampleResponse(1, "c1", true);
    const auto file = folder_ / "extra.csv";
    const auto with = [&](const std::string& rule) {
        test::writeRows(file, {extra});
        return run(data + " '" + file.string() + "' " + rule).status;
    };
    EXPECT_EQ(with(""), 1);
    EXPECT_EQ(with("--allow-duplicates"), 0);
    extra = test::sampleResponse(29, "c1", true);
    EXPECT_EQ(with(""), 0);
    extra.protocolSha256 = std::string(64, 'f'); // a mended text
    EXPECT_EQ(with(""), 0);
    extra.designSha256 = std::string(64, 'f');
    EXPECT_EQ(with(""), 1);
    EXPECT_EQ(with("--allow-mixed-protocols"), 0);
    extra.studyId = "another";
    EXPECT_EQ(with("--allow-mixed-protocols"), 1);
    EXPECT_EQ(with("--allow-mixed-studies"), 0);
    extra = test::sampleResponse(29, "c1", true);
    extra.simulated = true;
    EXPECT_EQ(with(""), 1);
    EXPECT_EQ(with("--simulated include"), 0);
    EXPECT_EQ(with("--simulated exclude"), 0);
    EXPECT_EQ(with("--simulated only"), 0);
    EXPECT_NE(with("--simulated perhaps"), 0);
    extra = test::sampleResponse(29, "c1", true);
    extra.interrupted = true;
    EXPECT_EQ(with("--exclude-interrupted"), 0);
    EXPECT_EQ(table().at("votes_b")[0], "19"); // as without it
}

TEST_F(Program, SaysWhatToInstallWithoutGnuplot) {
    const Outcome outcome = run(study(), "PATH=/nonexistent");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.output, "obscura-analysis: gnuplot is not installed and draws the chart; on "
                              "Debian: apt-get install gnuplot-nox\n");
    EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(Program, AsksForDataAndRefusesContradictions) {
    EXPECT_EQ(run("").output, "obscura-analysis: expected a study's folder, CSV files, or --counts "
                              "FILE; see --help\n");
    EXPECT_THAT(run("--counts x.csv --stimuli y").output, HasSubstr("--counts excludes --stimuli"));
}

} // namespace
} // namespace obscura
