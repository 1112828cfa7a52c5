#include "protocols/reader/display.h"
#include "protocols/reader/study_parts.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::HasSubstr;

Display parsed(const std::string& text, double distanceCm = 0) {
    const toml::table table = parseToml(text, "small.toml");
    return parseDisplay(TomlTable(table, "small.toml", "display"), distanceCm);
}

Display given(const std::vector<std::string>& words) { return displayOf(words); }

// As the authors of ColorVideoVDP print it of their standard displays.
TEST(Display, HasPixelsPerDegree) {
    EXPECT_NEAR(given({"standard_fhd"}).pixelsPerDegree(), 37.842504, 1e-6);
    EXPECT_NEAR(given({"standard_4k"}).pixelsPerDegree(), 75.402449, 1e-6);
    EXPECT_NEAR(given({"laptop"}).pixelsPerDegree(), 40.410030, 1e-6);
}

TEST(Display, OfAStudyThatSaysNothingIsTheFirst) {
    EXPECT_EQ(parsed(""), displays().front());
    EXPECT_EQ(given({}), displays().front());
}

TEST(Display, IsANamedOneWithWhatIsChanged) {
    Display wanted = given({"standard_4k"});
    wanted.name.clear();
    wanted.peak = 120;
    wanted.distance = 0.5;
    EXPECT_EQ(parsed("name = \"standard_4k\"\npeak = 120\ndistanceCm = 50"), wanted);
    EXPECT_EQ(given({"standard_4k", "peak=120", "distanceCm=50"}), wanted);
    EXPECT_EQ(parsed("name = \"laptop\"").name, "laptop");
}

TEST(Display, TakesTheScreensDistanceUnlessItHasItsOwn) {
    EXPECT_DOUBLE_EQ(parsed("", 80).distance, 0.8);
    EXPECT_DOUBLE_EQ(parsed("distanceCm = 50", 80).distance, 0.5);
}

TEST(Display, IsTheSameFromItsNumbers) {
    for (const Display& display : displays()) {
        std::vector<std::string> words;
        for (const auto& [key, value] : numbersOf(display))
            words.push_back(key + "=" + std::to_string(value));
        Display again = given(words);
        EXPECT_EQ(again.name, "");
        again.name = display.name;
        EXPECT_EQ(again, display);
    }
}

TEST(Display, ErrorsSayWhatThereIs) {
    EXPECT_THAT(test::errorOf([] { parsed("peek = 100"); }),
                HasSubstr("small.toml:1:1: display.peek"));
    EXPECT_THAT(test::errorOf([] { parsed("name = \"laptob\""); }), HasSubstr("laptop"));
    EXPECT_THAT(test::errorOf([] { parsed("peak = 0"); }), HasSubstr("from 1 to 100000"));
    EXPECT_THAT(test::errorOf([] { given({"labtop"}); }),
                HasSubstr("found \"labtop\"; did you mean \"laptop\"?"));
    EXPECT_THAT(test::errorOf([] { given({"x"}); }),
                HasSubstr("one of: standard_fhd, standard_4k, laptop"));
    EXPECT_THAT(test::errorOf([] { given({"peak=-1"}); }), HasSubstr("peak to be a number"));
    EXPECT_THAT(test::errorOf([] { given({"width=640.5"}); }), HasSubstr("whole number"));
    EXPECT_THAT(test::errorOf([] { given({"peak=nan"}); }), HasSubstr("peak"));
    EXPECT_THAT(test::errorOf([] { given({"weight=3"}); }), HasSubstr("weight"));
}

} // namespace
} // namespace obscura
