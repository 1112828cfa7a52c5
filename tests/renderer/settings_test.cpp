#include "renderer/settings.h"

#include <gtest/gtest.h>

namespace obscura {
namespace {

const Place place{"study.toml", 7, 3, "techniques.mine.samples"};

std::string messageOf(const std::string& techniqueId, const std::string& name, double value) {
    TechniqueSetting setting{
        "mine", techniqueId, {{name, value, place}}, {"study.toml", 6, 1, "techniques.mine"}};
    try {
        settingsOf(setting, 0.25);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(SettingsTest, FillsInDefaultsAndTheScenesRadius) {
    const Settings settings = settingsOf({"mine", "blizzard", {{"samples", 8, place}}, {}}, 0.25);
    EXPECT_EQ(settings["samples"], 8);
    EXPECT_EQ(settings["radius"], 0.25f);
    EXPECT_EQ(settings["blur"], 1);
    EXPECT_EQ(settings.named().size(), settings.technique().parameters.size());
}

TEST(SettingsTest, ATechniquesOwnRadiusWins) {
    EXPECT_EQ(settingsOf({"mine", "crytek", {{"radius", 2, place}}, {}}, 0.25)["radius"], 2);
}

TEST(SettingsTest, ErrorsNameThePlaceInTheProtocol) {
    EXPECT_EQ(messageOf("blizard", "samples", 8),
              "study.toml:6:1: techniques.mine: expected the id of a technique, found \"blizard\"; "
              "did you mean \"blizzard\"?");
    EXPECT_EQ(messageOf("blizzard", "sample", 8),
              "study.toml:7:3: techniques.mine.samples: technique \"blizzard\" has no setting "
              "\"sample\"; did you mean \"samples\"?");
    EXPECT_EQ(
        messageOf("blizzard", "samples", 0),
        "study.toml:7:3: techniques.mine.samples: expected a whole number from 1 to 16384 for "
        "\"samples\", found 0");
    EXPECT_EQ(
        messageOf("blizzard", "samples", 2.5),
        "study.toml:7:3: techniques.mine.samples: expected a whole number from 1 to 16384 for "
        "\"samples\", found 2.5");
    EXPECT_EQ(messageOf("none", "samples", 8),
              "study.toml:7:3: techniques.mine.samples: technique \"none\" has no settings, found "
              "\"samples\"");
}

} // namespace
} // namespace obscura
