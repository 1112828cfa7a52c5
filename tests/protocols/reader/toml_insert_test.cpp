#include "protocols/reader/toml_insert.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::HasSubstr;

const NewTable scene{"scenes", "b", {{"builtin", "\"atrium\""}, {"radius", "2"}}};
const NewTable condition{"conditions", "", {{"id", "\"two\""}}};

std::string with(const std::string& text, const NewTable& table) {
    return withTables(text, "mine.toml", {table});
}

// Expected texts are written by hand: what a person would have typed.
TEST(TomlInsert, AHeadingFollowsTheLastOfItsKind) {
    EXPECT_EQ(with(R"(# mine
name = "x"

[scenes.a] # first
builtin = "atrium"
radius = 1 # metres
# radius = 3 was too large

# Light.
[levels.low]
ambient = [1, 1, 1]
)",
                   scene),
              R"(# mine
name = "x"

[scenes.a] # first
builtin = "atrium"
radius = 1 # metres
# radius = 3 was too large

[scenes.b]
builtin = "atrium"
radius = 2

# Light.
[levels.low]
ambient = [1, 1, 1]
)");
}

TEST(TomlInsert, RemarksOfWhatFollowsStayWithIt) {
    EXPECT_EQ(with("[scenes.a]\nradius = 1\n# Light.\n[levels.low]\n", scene),
              "[scenes.a]\nradius = 1\n\n[scenes.b]\nbuiltin = \"atrium\"\nradius = 2\n# "
              "Light.\n[levels.low]\n");
}

TEST(TomlInsert, BlocksThatStandCloseStayClose) {
    EXPECT_EQ(
        with("seed = 1\n[scenes.a]\nradius = 1\n[scenes.c]\nradius = 1\n[levels.low]\n", scene),
        "seed = 1\n[scenes.a]\nradius = 1\n[scenes.c]\nradius = 1\n[scenes.b]\nbuiltin = "
        "\"atrium\"\nradius = 2\n[levels.low]\n");
}

TEST(TomlInsert, ATableOfATableIsPartOfIt) {
    EXPECT_EQ(with("\n[scenes.a]\nradius = 1\n\n[scenes.a.camera]\nfovDegrees = 50\n", scene),
              "\n[scenes.a]\nradius = 1\n\n[scenes.a.camera]\nfovDegrees = 50\n\n[scenes.b]\n"
              "builtin = \"atrium\"\nradius = 2\n");
}

TEST(TomlInsert, TablesOnALineGetALine) {
    EXPECT_EQ(with("[scenes]\n  a = { radius = 1 } # one\n\n[levels.low]\n", scene),
              "[scenes]\n  a = { radius = 1 } # one\n  b = { builtin = \"atrium\", radius = 2 }\n\n"
              "[levels.low]\n");
}

TEST(TomlInsert, ListsOfTables) {
    EXPECT_EQ(
        with("[[conditions]]\nid = \"one\"\n\n[texts]\nthanks = \"\"\"\n[[conditions]]\n\"\"\"\n",
             condition),
        "[[conditions]]\nid = \"one\"\n\n[[conditions]]\nid = \"two\"\n\n[texts]\nthanks = "
        "\"\"\"\n[[conditions]]\n\"\"\"\n");
}

TEST(TomlInsert, ListsInBrackets) {
    EXPECT_EQ(with("conditions = [\n    { id = \"ä\" }, # 1\n]\n", condition),
              "conditions = [\n    { id = \"ä\" }, # 1\n    { id = \"two\" },\n]\n");
    EXPECT_EQ(with("conditions = [\n    { id = \"ä\" } # 1\n]\n", condition),
              "conditions = [\n    { id = \"ä\" }, # 1\n    { id = \"two\" }\n]\n");
    EXPECT_EQ(with("conditions = [{ id = \"ä\" }] # 1\n", condition),
              "conditions = [{ id = \"ä\" }, { id = \"two\" }] # 1\n");
    EXPECT_EQ(with("conditions = [\n    { id = \"ä\" }]\n", condition),
              "conditions = [\n    { id = \"ä\" }, { id = \"two\" }]\n");
}

TEST(TomlInsert, WhatIsNotThereYetComesLast) {
    EXPECT_EQ(with("name = \"x\"\n\n\n", scene),
              "name = \"x\"\n\n[scenes.b]\nbuiltin = \"atrium\"\nradius = 2\n\n\n");
    EXPECT_EQ(with("[scenes] # none yet", scene),
              "[scenes] # none yet\n\n[scenes.b]\nbuiltin = \"atrium\"\nradius = 2\n");
}

TEST(TomlInsert, LineEndsAndMarksStay) {
    EXPECT_EQ(with("\xEF\xBB\xBF"
                   "conditions = [{ id = \"one\" }]\r\n\r\n[scenes.a]\r\nradius = 1\r\n",
                   scene),
              "\xEF\xBB\xBF"
              "conditions = [{ id = \"one\" }]\r\n\r\n[scenes.a]\r\nradius = 1\r\n\r\n"
              "[scenes.b]\r\nbuiltin = \"atrium\"\r\nradius = 2\r\n");
    EXPECT_EQ(with("\xEF\xBB\xBF"
                   "conditions = [{ id = \"one\" }]\r\n",
                   condition),
              "\xEF\xBB\xBF"
              "conditions = [{ id = \"one\" }, { id = \"two\" }]\r\n");
}

TEST(TomlInsert, WhatCannotBeAddedToIsAnError) {
    EXPECT_THAT(test::errorOf([] { with("\nscenes = { a = { radius = 1 } }\n", scene); }),
                testing::AllOf(HasSubstr("mine.toml:2:"), HasSubstr("[scenes.NAME]"),
                               HasSubstr("{ builtin = \"atrium\", radius = 2 }")));
    EXPECT_THAT(test::errorOf([] { with("a = = 1\n", scene); }), HasSubstr("mine.toml:1:"));
}

} // namespace
} // namespace obscura
