#include "base/arguments.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::HasSubstr;

TEST(NamedNumberTest, IsANameAndAWholeNumberAfterIt) {
    const NamedNumber read = parseNamedNumber("--set", "angleBias=-1.5e-1");
    EXPECT_EQ(read.name, "angleBias");
    EXPECT_EQ(read.value, -0.15);
}

TEST(NamedNumberTest, IsNothingElse) {
    for (const char* text :
         {"", "blur", "=", "=1", "blur=", "blur=yes", "blur=10abc", "blur=1=2", "blur= 1",
          "blur=1 ", "blur=0,5", "blur=nan", "blur=inf", "blur=-inf", "blur=1e999", "blur=0x10"})
        EXPECT_THAT(test::errorOf([&] { parseNamedNumber("--set", text); }),
                    HasSubstr(std::string("found \"") + text + "\""));
}

TEST(NamedNumberTest, KnowsTheNearestName) {
    const std::string names[] = {"blur", "angleBias"};
    EXPECT_EQ(parseNamedNumber("--set", "blur=1", names).value, 1);
    EXPECT_THAT(test::errorOf([&] { parseNamedNumber("--set", "blurr=1", names); }),
                HasSubstr("\"blurr\" is none of its names; did you mean \"blur\"?"));
}

TEST(PairTest, IsTwoWholeNumbersAndNothingElse) {
    EXPECT_EQ(parsePair("1280x800", 'x'), std::pair(1280, 800));
    EXPECT_EQ(parsePair("2/3", '/'), std::pair(2, 3));
    for (const char* text : {"", "x", "1280", "1280x", "x800", "1280x800x", "1280 x800", "-1x2",
                             "0x100", "1.5x2", "99999999999x1", "1280/800"})
        EXPECT_FALSE(parsePair(text, 'x')) << text;
}

TEST(NumberFromTest, TakesOnlyNumbersOfTheRange) {
    const auto check = numberFrom(0.5, 180);
    EXPECT_EQ(check("0.5"), "");
    EXPECT_EQ(check("1e2"), "");
    for (const char* text : {"", "0.4", "181", "nan", "inf", "-inf", "abc", "10abc", "0x10", "1,5"})
        EXPECT_THAT(check(text), HasSubstr("expected a number from 0.5 to 180")) << text;
}

} // namespace
} // namespace obscura
