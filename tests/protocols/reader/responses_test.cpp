#include "base/csv.h"
#include "base/files.h"
#include "protocols/reader/responses.h"
#include "tests/protocols/reader/sample_response.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace obscura {
namespace {

using test::sampleResponse;
using testing::ElementsAre;

// A file of its own for each test, and what reading it says.
class Responses : public testing::Test {
  protected:
    Responses() {
        std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
        std::replace(test.begin(), test.end(), '/', '-');
        path_ = std::filesystem::temp_directory_path() /
                fmt::format("obscura-{}-{}.csv", test, ::getpid());
    }
    ~Responses() override { std::filesystem::remove(path_); }

    ResponseFile read(const std::string& content, bool lenient = false) {
        writeFile(path_, content);
        return readResponses(path_, lenient);
    }

    // The message without the path in front.
    std::string errorOf(const std::string& content) {
        try {
            read(content);
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.rfind(path_.string(), 0), 0u) << message;
            return message.substr(path_.string().size());
        }
        ADD_FAILURE() << "accepted";
        return {};
    }

    // One good row, `bad`, another good row: the error of the second line of data.
    std::string errorOf(const Response& bad) {
        return errorOf(responseHeader() + responseLine(sampleResponse(1, "c1", true)) +
                       responseLine(bad) + responseLine(sampleResponse(3, "c1", true)));
    }

    std::filesystem::path path_;
};

TEST_F(Responses, EveryColumnHasANameOfItsOwnAndADescription) {
    std::set<std::string_view> names;
    for (const Column& column : responseColumns()) {
        EXPECT_TRUE(names.insert(column.name).second) << column.name;
        EXPECT_FALSE(column.description.empty()) << column.name;
        EXPECT_FALSE(column.expected.empty()) << column.name;
    }
    EXPECT_EQ(names.size(), 50u);
}

TEST_F(Responses, SurviveWritingAndReading) {
    Response given = sampleResponse(3, "c,\"1\"", false);
    given.scene = "two\nlines\r\nand \"quotes\", commas";
    given.hypothesis = "";
    given.machineId = "Überlab µ";
    given.decisionRtMs = 1234.5678;
    given.interrupted = true;
    const ResponseFile read = this->read(responseHeader() + responseLine(given) +
                                         responseLine(sampleResponse(4, "c2", true)));
    ASSERT_EQ(read.rows.size(), 2u);
    EXPECT_EQ(responseLine(read.rows[0]), responseLine(given));
    EXPECT_EQ(read.rows[0].scene, given.scene);
    EXPECT_EQ(read.rows[0].paramsB, given.paramsB);
    EXPECT_DOUBLE_EQ(read.rows[0].decisionRtMs, 1234.568); // microseconds are kept
    EXPECT_THAT(read.lines, ElementsAre(2, 5));            // the first row spans three lines
}

TEST_F(Responses, AreReadFromASpreadsheetsFile) {
    std::string content =
        "\xEF\xBB\xBF" + responseHeader() + responseLine(sampleResponse(1, "c", 1));
    for (std::size_t at = 0; (at = content.find('\n', at)) != content.npos; at += 2)
        content.replace(at, 1, "\r\n");
    EXPECT_EQ(read(content).rows.at(0).wallTimeUtc, "2026-01-31T23:59:59Z");
}

TEST_F(Responses, KeepTheJoinersThatScriptsNeed) {
    Response row = sampleResponse(1, "c1", true);
    row.participantId = "می\u200Cخواهم";
    EXPECT_EQ(read(responseHeader() + responseLine(row)).rows.at(0).participantId,
              row.participantId);
}

TEST_F(Responses, SayHowATableOfVotesIsRead) {
    EXPECT_EQ(
        errorOf("condition_id,level,scene,tech_a,tech_b,hypothesis,votes_a,votes_b\n"),
        ":1: votes_a: expected the rows of participants, found a table of counted votes; give "
        "it as --counts FILE");
}

TEST_F(Responses, NameFileLineColumnAndWhatWasExpected) {
    Response row = sampleResponse(2, "c1", true);
    row.trialIndex = 0;
    EXPECT_EQ(errorOf(row), ":3:11: trial_index: expected a whole number >= 1, found \"0\"; "
                            "--lenient skips it");
}

struct Fault {
    const char* name;
    void (*spoil)(Response&);
    const char* message;
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

class BadValue : public Responses, public testing::WithParamInterface<Fault> {};

TEST_P(BadValue, IsRefused) {
    Response row = sampleResponse(2, "c1", true);
    GetParam().spoil(row);
    EXPECT_EQ(errorOf(row), fmt::format(":3:{}; --lenient skips it", GetParam().message));
}

const Fault faults[] = {
    {"version", [](Response& r) { r.schemaVersion = 1; },
     "1: schema_version: expected 2, whose columns the header names, found 1"},
    {"participant", [](Response& r) { r.participantId = ""; },
     "4: participant_id: expected text, not empty, found \"\""},
    {"kind", [](Response& r) { r.trialKind = "warm-up"; },
     "12: trial_kind: expected practice, main or catch, found \"warm-up\""},
    {"hash", [](Response& r) { r.sha256First = "abc"; },
     "24: sha256_first: expected 64 hexadecimal digits, found \"abc\""},
    {"first", [](Response& r) { r.firstIs = "c"; }, "26: first_is: expected a or b, found \"c\""},
    {"negative", [](Response& r) { r.view1Ms = -1; },
     "28: view1_ms: expected a number from 0 to 1e9, found \"-1.000\""},
    {"nan", [](Response& r) { r.view2Ms = std::nan(""); },
     "33: view2_ms: expected a number from 0 to 1e9, found \"nan\""},
    {"endless", [](Response& r) { r.decisionRtMs = 1e10; },
     "35: decision_rt_ms: expected a number from 0 to 1e9, found \"10000000000.000\""},
    {"unseen", [](Response& r) { r.participantId = "S\u200B01"; },
     "4: participant_id: expected \"S01\", found \"S\u200B01\", with characters in it that nobody "
     "sees, which make another name of it; type it anew"},
    {"mirrored", [](Response& r) { r.conditionId = "c\u202E1"; },
     "14: condition_id: expected \"c1\", found \"c\u202E1\", with characters in it that nobody "
     "sees, which make another name of it; type it anew"},
    {"infinite", [](Response& r) { r.refreshHz = HUGE_VAL; },
     "36: refresh_hz: expected a number from 1 to 10000, found \"inf\""},
    {"position", [](Response& r) { r.chosenPosition = 3; },
     "39: chosen_position: expected 1 or 2, found \"3\""},
    {"technique", [](Response& r) { r.chosenTechnique = "none"; },
     "40: chosen_technique: expected technique_b's value when chose_b is 1, else technique_a's, "
     "found \"none\""},
    {"choice", [](Response& r) { r.chosenPosition = 1; },
     "41: chose_b: expected 1 when chosen_position and first_is say so, else 0, found \"1\""},
    {"time", [](Response& r) { r.wallTimeUtc = "2026-01-31 23:59:59Z"; },
     "48: wall_time_utc: expected a time such as 2026-01-31T23:59:59Z, found \"2026-01-31 "
     "23:59:59Z\""},
};
INSTANTIATE_TEST_SUITE_P(Responses, BadValue, testing::ValuesIn(faults),
                         [](const auto& fault) { return std::string(fault.param.name); });

TEST_F(Responses, RefuseCellsThatAreNotNumbers) {
    std::string line = responseLine(sampleResponse(1, "c1", true));
    line.replace(0, 1, "1x");
    EXPECT_EQ(errorOf(responseHeader() + line),
              ":2:1: schema_version: expected the version whose columns the header names, found "
              "\"1x\"; --lenient skips it");
}

TEST_F(Responses, RefuseAnotherHeader) {
    std::string header = responseHeader();
    EXPECT_EQ(errorOf("row_ident" + header.substr(header.find(','))),
              ":1: row_ident: unknown column; did you mean \"row_id\"?");
    EXPECT_EQ(errorOf("schema_version,row_id\n"),
              ":1:3: expected column \"study_id\", found \"end of line\"");
    header.insert(header.size() - 1, ",row_id");
    EXPECT_EQ(errorOf(header), ":1: row_id: the column stands twice in the header");
}

// Data of version 0.1.0, which knew no rehearsals and no design.
TEST_F(Responses, ReadFilesOfAnEarlierVersionAndSaySo) {
    const auto without = [](std::string line) { // the two columns of version 2
        line.resize(line.rfind(',', line.rfind(',') - 1));
        return line + "\n";
    };
    Response row = sampleResponse(1, "c1", true);
    row.schemaVersion = 1;
    const std::string header = without(responseHeader());
    const ResponseFile old = read(header + without(responseLine(row)));
    EXPECT_EQ(old.version, 1);
    ASSERT_EQ(old.rows.size(), 1u);
    EXPECT_FALSE(old.rows[0].rehearsal);
    EXPECT_EQ(old.rows[0].designSha256, "");
    EXPECT_EQ(read(responseHeader() + responseLine(sampleResponse(1, "c1", true))).version, 2);

    EXPECT_EQ(errorOf(header + without(responseLine(sampleResponse(1, "c1", true)))),
              ":2:1: schema_version: expected 1, whose columns the header names, found 2; "
              "--lenient skips it");
    std::string half = responseHeader();
    half.resize(half.rfind(','));
    EXPECT_EQ(errorOf(half + "\n"),
              ":1:50: expected column \"design_sha256\", found \"end of line\"");
}

TEST_F(Responses, RefuseALineOfAnotherLength) {
    EXPECT_EQ(errorOf(responseHeader() + "1,2,3\n"),
              ":2: expected 50 columns, found 3; --lenient skips it");
}

TEST_F(Responses, RefuseATornLastLine) {
    std::string torn = responseLine(sampleResponse(2, "c1", true));
    torn.resize(torn.size() / 2);
    const std::string content =
        responseHeader() + responseLine(sampleResponse(1, "c1", true)) + torn;
    EXPECT_EQ(errorOf(content),
              ":3: the line has no end: it was cut off while being written; --lenient skips it");
    const ResponseFile lenient = read(content, true);
    EXPECT_EQ(lenient.rows.size(), 1u);
    ASSERT_EQ(lenient.bad.size(), 1u);
    EXPECT_EQ(lenient.bad[0].place.line, 3);
}

TEST_F(Responses, TakeBlankLinesAndAWholeLastRowWithoutLineFeed) {
    const std::string row = responseLine(sampleResponse(1, "c1", true));
    std::string last = responseLine(sampleResponse(2, "c1", true));
    last.pop_back();
    const ResponseFile file =
        read(responseHeader() + "\n" + row + std::string(49, ',') + "\r\n \n" + last);
    EXPECT_THAT(file.lines, ElementsAre(3, 6));
    EXPECT_EQ(read(responseHeader() + row + "\n\n").rows.size(), 1u);
    last.pop_back(); // torn within the last cell
    EXPECT_THAT(errorOf(responseHeader() + last), testing::HasSubstr("64 hexadecimal digits"));
}

TEST_F(Responses, RefuseForeignBytesAndStrayNames) {
    const auto fault = [&](std::string Response::*field, const std::string& text) {
        Response row = sampleResponse(1, "c1", true);
        row.*field = text;
        return errorOf(responseHeader() + responseLine(row));
    };
    using testing::HasSubstr;
    using testing::StartsWith;
    const std::string nul("a\0b", 3);
    EXPECT_THAT(fault(&Response::machineId, nul),
                StartsWith(":2:47: machine_id: expected text, found the byte 0x00 at byte 2 of"));
    EXPECT_THAT(fault(&Response::paramsA, "a\x01"), HasSubstr("the byte 0x01"));
    EXPECT_THAT(fault(&Response::stimFirst, "caf\xE9"),
                HasSubstr("expected text in UTF-8, found the byte 0xE9 at byte 4"));
    EXPECT_THAT(fault(&Response::scene, "\xED\xA0\x80"), HasSubstr("expected text in UTF-8"));
    EXPECT_THAT(fault(&Response::participantId, "S01 "),
                StartsWith(":2:4: participant_id: expected \"S01\", found \"S01 \", with blanks"));
    EXPECT_THAT(fault(&Response::conditionId, "c1\xC2\xA0"), HasSubstr("expected \"c1\""));
    EXPECT_THAT(fault(&Response::level, "\xE2\x80\x8Blow"), HasSubstr("expected \"low\""));
    EXPECT_THAT(fault(&Response::participantId, "1.00E+05"), HasSubstr("a spreadsheet"));
    EXPECT_NO_THROW(read(responseHeader()));
    Response accented = sampleResponse(1, "c1", true);
    accented.scene = "caf\xC3\xA9 \xE7\x92\xB0";
    EXPECT_EQ(read(responseHeader() + responseLine(accented)).rows.size(), 1u);
}

TEST_F(Responses, HintAtWhatASpreadsheetOrScriptDid) {
    const std::string header = responseHeader(), row = responseLine(sampleResponse(1, "c1", true));
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = row;
        text.replace(text.find(from), from.size(), to);
        return errorOf(header + text);
    };
    using testing::HasSubstr;
    EXPECT_THAT(changed("4000.000", "\"4000,000\""), HasSubstr("decimal comma: write a point"));
    EXPECT_THAT(changed(",0,1,1,", ",FALSE,1,1,"), HasSubstr("write 1 for true, 0 for false"));
    EXPECT_THAT(changed(std::string(64, 'd'), "1.93E+63"), HasSubstr("take the original file"));
    EXPECT_THAT(changed("4000.000", " 4000"), HasSubstr("remove the blanks"));
    EXPECT_THAT(errorOf(header + row + header), HasSubstr(":3: the header stands here again"));
    EXPECT_THAT(errorOf("# by x\n" + header + row), HasSubstr(":1: expected the header, found a "
                                                              "comment"));
    EXPECT_THAT(errorOf("," + header), HasSubstr("pandas"));
    EXPECT_THAT(errorOf("age," + header), HasSubstr(":1: age: unknown column; remove it"));
    EXPECT_THAT(errorOf(header.substr(0, header.size() - 1) + ",\n"),
                HasSubstr(":1:51: found a column without a name"));
}

TEST_F(Responses, RefuseATornHeader) {
    for (const std::string& content : {std::string(), responseHeader().substr(0, 40)}) {
        EXPECT_EQ(errorOf(content), ": expected a header line; the file ends before that line "
                                    "does; --lenient skips it");
        const ResponseFile lenient = read(content, true);
        EXPECT_TRUE(lenient.rows.empty());
        EXPECT_EQ(lenient.bad.size(), 1u);
    }
}

TEST_F(Responses, ReportEachBadRowWhenLenientAndKeepTheOthers) {
    Response bad = sampleResponse(2, "c1", true);
    bad.slotId = 0;
    const ResponseFile read = this->read(responseHeader() + responseLine(bad) +
                                             responseLine(sampleResponse(1, "c1", true)) + "x\n" +
                                             responseLine(sampleResponse(3, "c1", true)),
                                         true);
    EXPECT_THAT(read.lines, ElementsAre(3, 5));
    ASSERT_EQ(read.bad.size(), 2u);
    EXPECT_EQ(read.bad[0].place.prefix() + read.bad[0].message,
              path_.string() + ":2:7: slot_id: expected a whole number >= 1, found \"0\"");
    EXPECT_EQ(read.bad[1].place.line, 4);
}

TEST(Csv, SplitsQuotedCells) {
    const auto records = splitCsv("a,\"b,\"\"c\"\"\nd\",\n\"\",x\r\n");
    ASSERT_EQ(records.size(), 2u);
    EXPECT_THAT(records[0].cells, ElementsAre("a", "b,\"c\"\nd", ""));
    EXPECT_THAT(records[1].cells, ElementsAre("", "x"));
    EXPECT_EQ(records[1].line, 3);
    EXPECT_TRUE(records[1].fault.empty());
}

TEST(Csv, KeepsALoneCarriageReturn) {
    EXPECT_THAT(splitCsv("a\rb,c\n").at(0).cells, ElementsAre("a\rb", "c"));
}

// Otherwise one stray quote would make the rest of the file a single bad row, or shift the meaning
// of every quote after it.
TEST(Csv, LetsAFaultSpoilOnlyItsOwnLine) {
    const auto records = splitCsv("a,b\"\n\"c,d\ne,\"f\"\n\"g\"h,i\nj,k\n");
    ASSERT_EQ(records.size(), 5u);
    EXPECT_EQ(records[0].fault, "a quote stands inside a cell that does not begin with one");
    EXPECT_EQ(records[1].fault,
              "a closing quote is followed by neither a comma nor the line's end");
    EXPECT_THAT(records[2].cells, ElementsAre("e", "f"));
    EXPECT_EQ(records[2].line, 3);
    EXPECT_FALSE(records[3].fault.empty());
    EXPECT_THAT(records[4].cells, ElementsAre("j", "k"));
    EXPECT_EQ(splitCsv("\"a\nb\n").at(0).fault, "a quote is opened and never closed");
    EXPECT_TRUE(splitCsv("\"a\nb\n").at(0).ended);
}

TEST(Csv, SeesWhetherTheLastLineEnded) {
    EXPECT_FALSE(splitCsv("a,b").at(0).ended);
    EXPECT_FALSE(splitCsv("a,\"b").at(0).ended);
    EXPECT_TRUE(splitCsv("a,b\n").at(0).ended);
    EXPECT_TRUE(splitCsv("").empty());
}

TEST(Csv, ReadsBackWhatItQuotes) {
    for (const std::string value : {"plain", "a,b", "say \"x\"", "two\nlines", "cr\r", "\"", ""}) {
        const auto records = splitCsv(csvCell(value) + "," + csvCell(value) + "\n");
        ASSERT_EQ(records.size(), 1u);
        EXPECT_THAT(records[0].cells, ElementsAre(value, value));
    }
}

} // namespace
} // namespace obscura
