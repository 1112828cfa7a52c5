#include "base/csv.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>
#include <utility>

namespace obscura {
namespace {

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

} // namespace
} // namespace obscura
