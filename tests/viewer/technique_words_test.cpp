#include "base/random.h"
#include "tests/error_of.h"
#include "viewer/technique_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace obscura {
namespace {

using testing::HasSubstr;

// Every parameter somewhere in its range, by lot.
Settings anyOf(const Technique& row, Random& random) {
    Settings settings(row);
    for (const Parameter& parameter : row.parameters) {
        const double low = static_cast<double>(parameter.low),
                     high = static_cast<double>(parameter.high);
        const double value = low + (high - low) * random.uniform();
        settings.set(parameter.name, isWhole(parameter) ? std::floor(value) : value);
    }
    return settings;
}

void expectSaidAgain(const Settings& settings, double radius) {
    const TechniqueSetting said = settingOf(settings, radius);
    EXPECT_EQ(settingsOf(said, radius).values(), settings.values()) << settings.technique().id;
    EXPECT_EQ(slug(said.name), said.name);
}

TEST(TechniqueWords, WhatIsSaidOfATechniqueIsAllOfIt) {
    Random random(1, "settings");
    for (const Technique& row : techniques()) {
        expectSaidAgain(Settings(row), 0.3);
        for (int i = 0; i < 4; ++i)
            expectSaidAgain(anyOf(row, random), 0.3);
        for (const Preset& preset : row.presets) {
            Settings settings(row);
            settings.apply(preset.name);
            if (settings.has("radius"))
                settings.set("radius", 0.3);
            expectSaidAgain(settings, 0.3);
            EXPECT_TRUE(settingOf(settings, 0.3).settings.empty()) << row.id << " " << preset.name;
        }
    }
}

TEST(TechniqueWords, TheSceneSaysTheRadius) {
    Settings settings(technique("gtao"));
    settings.set("radius", 0.7);
    EXPECT_TRUE(settingOf(settings, 0.7).settings.empty());
    ASSERT_EQ(settingOf(settings, 0.5).settings.size(), 1u);
    EXPECT_EQ(settingOf(settings, 0.5).settings[0].name, "radius");
}

TEST(TechniqueWords, NamesAreWhatPeopleWouldCallThem) {
    EXPECT_EQ(techniqueIn("none").name, "none");
    EXPECT_EQ(techniqueIn("crytek samples=24").name, "crytek24");
    EXPECT_EQ(techniqueIn("gtao high").name, "gtao-high");
    EXPECT_EQ(techniqueIn("starcraft samples=8 downscale=2").name, "starcraft8-half");
    EXPECT_EQ(techniqueIn("gtao high downscale=2 intensity=0.5").name, "gtao-high-half-tuned");
    EXPECT_EQ(techniqueIn("visibility_bitmask").name, "visibility-bitmask");
}

TEST(TechniqueWords, WordsAreReadWithTheTablesRanges) {
    const TechniqueSetting read = techniqueIn("gtao high slices=6");
    EXPECT_EQ(read.technique, "gtao");
    EXPECT_EQ(read.preset->name, "high");
    ASSERT_EQ(read.settings.size(), 1u);
    EXPECT_EQ(read.settings[0].value, 6);
    EXPECT_THAT(test::errorOf([] { techniqueIn("gtaoo"); }), HasSubstr("did you mean \"gtao\""));
    EXPECT_THAT(test::errorOf([] { techniqueIn("gtao hihg"); }), HasSubstr("\"high\""));
    EXPECT_THAT(test::errorOf([] { techniqueIn("crytek samples=0.5"); }), HasSubstr("whole"));
    EXPECT_THAT(test::errorOf([] { techniqueIn("crytek sampels=8"); }), HasSubstr("\"samples\""));
    EXPECT_THAT(test::errorOf([] { techniqueIn(""); }), HasSubstr("technique"));
}

TEST(TechniqueWords, SlugsAreNames) {
    EXPECT_EQ(slug("My Scene (2).v3"), "my-scene-2-v3");
    EXPECT_EQ(slug("大_"), "");
}

} // namespace
} // namespace obscura
