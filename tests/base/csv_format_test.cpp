#include "base/csv.h"
#include "base/files.h"
#include "base/random.h"
#include "tests/error_of.h"
#include "tests/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>
#include <utility>

namespace obscura {
namespace {

using namespace std::string_literals;
using namespace std::string_view_literals;
using testing::HasSubstr;
using testing::StartsWith;

TEST(CsvFormatTest, AnotherFormatIsNamedInPlainWords) {
    for (const auto& each : {std::pair{"\x1F\x8B\x08"sv, "gzip"},
                             {"PK\x03\x04 "sv, "xlsx"},
                             {"\xD0\xCF\x11\xE0 "sv, "xls"},
                             {"\xFF\xFE"
                              "a\0"sv,
                              "UTF-16"},
                             {"a\0,\0"sv, "UTF-16"},
                             {"\0a\0,"sv, "UTF-16"},
                             {" \n<html>"sv, "web page"},
                             {"a;b\n1;2\n"sv, "semicolons"},
                             {"a\tb\n"sv, "tabs"},
                             {"a,b\r1,2\r"sv, "CR alone"}}) {
        const std::string_view text = each.first;
        const std::string words = each.second;
        const std::string error = test::errorOf([&] { checkIsCsv(text, "x.csv"); });
        EXPECT_THAT(error, StartsWith("x.csv:1: expected"));
        EXPECT_THAT(error, HasSubstr(words));
    }
}

TEST(CsvFormatTest, CommasAreWell) {
    for (const auto text : {""sv, "a"sv, "a,b\r\n1,2\r\n"sv,
                            "\xEF\xBB\xBF"
                            "a,b\n"sv,
                            "a,\"b;c\"\n"sv})
        EXPECT_NO_THROW(checkIsCsv(text, "x.csv"));
}

// A file that is read in pieces has the records of the whole text, whatever stands at the pieces'
// ends.
TEST(CsvReaderTest, AFileIsItsText) {
    const test::Folder folder;
    Random random(7, "text");
    for (const std::string& alphabet : {"ab,\n"s, "a,\"\n"s, "a\r\n,"s, "\"\r\n,a"s}) {
        std::string text = "header,of,no,other,format\n";
        while (text.size() < 300000)
            text += alphabet[random.below(static_cast<std::uint32_t>(alphabet.size()))];
        const auto path = folder / "text.csv";
        writeFile(path, text);
        const std::vector<CsvRecord> expected = splitCsv(text);
        CsvReader reader(path);
        CsvRecord record;
        std::size_t count = 0;
        for (; reader.next(record); ++count) {
            ASSERT_LT(count, expected.size());
            ASSERT_EQ(record.cells, expected[count].cells) << count;
            ASSERT_EQ(record.line, expected[count].line);
            ASSERT_EQ(record.fault, expected[count].fault);
            ASSERT_EQ(record.ended, expected[count].ended);
        }
        EXPECT_EQ(count, expected.size());
    }
}

} // namespace
} // namespace obscura
