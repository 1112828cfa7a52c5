#include "protocols/reader/keys.h"
#include "protocols/reader/toml_table.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Keys parsed(const std::string& lines) {
    const toml::table table = toml::parse(lines);
    return parseKeys(TomlTable(table, "study.toml", "keys"));
}
std::string errorOf(const std::string& lines) {
    return test::errorOf([&] { parsed(lines); });
}

TEST(Keys, AreTheUsualOnesUnlessNamed) {
    EXPECT_EQ(parsed(""), Keys());
    const Keys keys = parsed("first = [\"f\", \"1\"]\nsecond = [\"j\", \"2\"]");
    EXPECT_THAT(keys.first, ElementsAre('F', '1'));
    EXPECT_THAT(keys.second, ElementsAre('J', '2'));
    EXPECT_EQ(keys.go, Keys().go);
    EXPECT_EQ(keys.optionOf('F'), 1);
    EXPECT_EQ(keys.optionOf('2'), 2);
    EXPECT_EQ(keys.optionOf(263), 0) << "the arrow is no longer one of them";
}

TEST(Keys, AreCalledAsTheirCapsAre) {
    EXPECT_EQ(capOf('F'), "F");
    EXPECT_EQ(capOf(32), "Space");
    EXPECT_EQ(capOf(parsed("go = [\"f5\"]").go.front()), "F5");
    EXPECT_EQ(nameOfKey(1000), "pad a");
}

TEST(Keys, ThatCannotBeAreRefusedWithTheirPlace) {
    EXPECT_THAT(errorOf("first = [\"spcae\"]"),
                HasSubstr("study.toml:1:10: keys.first[1]: expected the name of a key"));
    EXPECT_THAT(errorOf("first = [\"spcae\"]"), HasSubstr("did you mean \"space\"?"));
    EXPECT_THAT(errorOf("first = [\"F\"]"), HasSubstr("found \"F\""));
    EXPECT_THAT(errorOf("go = []"), HasSubstr("keys.go"));
    EXPECT_THAT(errorOf("go = \"space\""), HasSubstr("keys.go"));
    EXPECT_THAT(errorOf("go = [\"escape\"]"), HasSubstr("asks whether to end the session"));
    EXPECT_THAT(errorOf("go = [\"1\"]"), HasSubstr("digits choose among options"));
    EXPECT_THAT(errorOf("go = [\"keypad 3\"]"), HasSubstr("digits choose among options"));
    EXPECT_THAT(errorOf("first = [\"enter\"]"), HasSubstr("ends pages of questions"));
    EXPECT_THAT(errorOf("first = [\"f\", \"f\"]"), HasSubstr("found \"f\" again"));
    EXPECT_THAT(errorOf("first = [\"f\"]\nsecond = [\"f\"]"),
                HasSubstr("\"f\" is both in \"first\" and in \"second\""));
    EXPECT_THAT(errorOf("first = [\"2\"]"), HasSubstr("usual keys; name them, too"));
    EXPECT_THAT(errorOf("third = [\"f\"]"), HasSubstr("unknown key"));
}

} // namespace
} // namespace obscura
