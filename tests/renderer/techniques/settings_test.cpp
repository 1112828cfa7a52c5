#include "base/error.h"
#include "renderer/techniques/settings.h"

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

const Place presetPlace{"study.toml", 8, 3, "techniques.mine.preset"};

TEST(SettingsTest, PresetsComeBeforeTheScenesRadiusAndExplicitSettings) {
    const Settings settings = settingsOf(
        {"mine", "gtao", {{"steps", 7, place}}, {}, PresetName{"ultra", presetPlace}}, 0.25);
    EXPECT_EQ(settings["slices"], 3);
    EXPECT_EQ(settings["steps"], 7);
    EXPECT_EQ(settings["radius"], 0.25f);
}

TEST(SettingsTest, UnknownPresetsNameTheNearest) {
    const auto message = [](const char* technique, const char* preset) -> std::string {
        try {
            settingsOf({"mine", technique, {}, {}, PresetName{preset, presetPlace}}, 0.25);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message("gtao", "hihg"),
              "study.toml:8:3: techniques.mine.preset: technique \"gtao\" has no preset \"hihg\"; "
              "did you mean \"high\"?");
    EXPECT_EQ(message("none", "high"), "study.toml:8:3: techniques.mine.preset: technique \"none\" "
                                       "has no presets, found \"high\"");
}

// The table's own check refuses presets that could not be set.
TEST(SettingsTest, PresetsOfTheTableAreChecked) {
    constexpr Parameter parameters[] = {
        {"steps", Unit::count, "meaning", 4, 1, 8, "source"},
        {"radius", Unit::metre, "meaning", 1, 0.1f, 10, "source"},
    };
    constexpr PresetValue good[] = {{"steps", 8}}, unknown[] = {{"step", 4}},
                          high[] = {{"steps", 9}}, fraction[] = {{"steps", 2.5f}},
                          radius[] = {{"radius", 1}};
    static_assert(wellFormed(Preset{"fine", good}, parameters));
    static_assert(!wellFormed(Preset{"", good}, parameters));
    static_assert(!wellFormed(Preset{"bad", unknown}, parameters));
    static_assert(!wellFormed(Preset{"bad", high}, parameters));
    static_assert(!wellFormed(Preset{"bad", fraction}, parameters));
    static_assert(!wellFormed(Preset{"bad", radius}, parameters));
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
