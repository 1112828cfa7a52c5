#include "protocols/reader/study_parts.h"
#include "protocols/reader/study_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace obscura {
namespace {

// What the reader makes of the text of one table.
template <typename Parse>
auto readBack(const std::string& text, Parse parse) {
    const toml::table parsed = parseToml("[it]\n" + text, "written.toml");
    return parse("it", *TomlTable(parsed, "written.toml", "").table("it"));
}

View readView(const View& view) {
    return readBack(tomlLines(fieldsOf(view)), [](const std::string& name, TomlTable table) {
        return parseView(name, std::move(table));
    });
}

Level readLevel(const Level& level) {
    return readBack(tomlLines(fieldsOf(level)), [](const std::string& name, TomlTable table) {
        return parseLevel(name, std::move(table));
    });
}

TEST(StudyText, NumbersReadBackExactlyAndLookAsPeopleWriteThem) {
    EXPECT_EQ(tomlNumber(0.1), "0.1");
    EXPECT_EQ(tomlNumber(1), "1");
    EXPECT_EQ(tomlNumber(-0.0), "0");
    for (const double value : {1.0 / 3, 1e-7, 123456.789, std::nextafter(0.1, 1.0),
                               std::numeric_limits<double>::min(), -1e300}) {
        const toml::table table = parseToml("it = " + tomlNumber(value), "written.toml");
        EXPECT_EQ(*table["it"].value<double>(), value);
    }
}

TEST(StudyText, TextsReadBack) {
    for (const std::string text :
         {"", "plain", "a \"b\"\\c", "tab\tline\nend", "\x01\x7f", "Größe 大"}) {
        const toml::table table =
            parseToml(fmt::format("{} = {}", tomlKey(text), tomlText(text)), "written.toml");
        EXPECT_EQ(*table[text].value<std::string>(), text);
    }
    EXPECT_EQ(tomlKey("gtao-high_2"), "gtao-high_2");
}

TEST(StudyText, AViewReadsBack) {
    View view;
    view.file = "a \"b\"/c.gltf";
    view.camera = {{-8, 1.9, 1.0 / 3}, {2, 2.9, -0.45}, {0, 0.8, 0.6}, 56.5, 0.001};
    view.radius = 0.35;
    view.exposure = -1.5;
    view.ground = Ground{-1.3, {0.45, 0.42, 0.38}};
    const View read = readView(view);
    EXPECT_EQ(read.file, view.file);
    EXPECT_EQ(read.camera.position, view.camera.position);
    EXPECT_EQ(read.camera.target, view.camera.target);
    EXPECT_EQ(read.camera.up, view.camera.up);
    EXPECT_EQ(read.camera.fovDegrees, view.camera.fovDegrees);
    EXPECT_EQ(read.camera.near, view.camera.near);
    EXPECT_EQ(read.radius, view.radius);
    EXPECT_EQ(read.exposure, view.exposure);
    EXPECT_EQ(read.ground, view.ground);
}

TEST(StudyText, WhatIsUsualIsNotSaid) {
    View view;
    view.builtin = "atrium";
    view.camera.target = {0, 0, -1};
    view.radius = 1;
    EXPECT_EQ(tomlLines(fieldsOf(view)),
              "builtin = \"atrium\"\ncamera = { position = [0, 0, 0], target = [0, 0, -1], "
              "fovDegrees = 50 }\nradius = 1\n");
}

TEST(StudyText, LevelsReadBack) {
    Level plain;
    plain.ambient = Vec3{1, 0.9, 0.8};
    plain.background = {0.2, 0.3, 0.4};
    plain.curve = Curve::reinhard; // not what constant light has by itself
    plain.white = 3;
    const Level readPlain = readLevel(plain);
    EXPECT_EQ(readPlain.ambient, plain.ambient);
    EXPECT_EQ(readPlain.background, plain.background);
    EXPECT_EQ(readPlain.curve, plain.curve);
    EXPECT_EQ(readPlain.white, plain.white);

    Level outdoors;
    outdoors.sky = Sky{{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}, {0.7, 0.8, 0.9}};
    outdoors.sun = Sun{62, 66, {4, 3.8, 3.4}};
    outdoors.curve = Curve::clamp;
    outdoors.occludeDirect = true;
    const Level readOutdoors = readLevel(outdoors);
    EXPECT_EQ(readOutdoors.sky->zenith, outdoors.sky->zenith);
    EXPECT_EQ(readOutdoors.sky->horizon, outdoors.sky->horizon);
    EXPECT_EQ(readOutdoors.sky->ground, outdoors.sky->ground);
    EXPECT_EQ(readOutdoors.sun->azimuthDegrees, 62);
    EXPECT_EQ(readOutdoors.sun->elevationDegrees, 66);
    EXPECT_EQ(readOutdoors.sun->irradiance, outdoors.sun->irradiance);
    EXPECT_EQ(readOutdoors.curve, Curve::clamp);
    EXPECT_TRUE(readOutdoors.occludeDirect);

    Level image;
    image.environment = "skies/a.hdr";
    image.sceneLights = true;
    EXPECT_EQ(readLevel(image).environment, "skies/a.hdr");
    EXPECT_TRUE(readLevel(image).sceneLights);
    for (const Curve curve : {Curve::clamp, Curve::reinhard, Curve::aces, Curve::neutral}) {
        image.curve = curve;
        EXPECT_EQ(readLevel(image).curve, curve);
    }
}

TEST(StudyText, ATechniqueReadsBackAsTheSameFloats) {
    const float third = 1.0f / 3;
    const TechniqueSetting given{
        "mine",
        "gtao",
        {{"falloff", static_cast<double>(third), {}}, {"adaptive", 1, {}}, {"slices", 3, {}}},
        {},
        PresetName{"high", {}}};
    const std::string text = tomlTable("techniques", given.name, fieldsOf(given, {"adaptive"}));
    EXPECT_EQ(text, "[techniques.mine]\ntechnique = \"gtao\"\npreset = \"high\"\nfalloff = "
                    "0.33333334\nadaptive = true\nslices = 3\n");
    const toml::table parsed = parseToml(text, "written.toml");
    TomlTable root(parsed, "written.toml", "");
    const TechniqueSetting read = parseTechniques(root).techniques.at(0);
    EXPECT_EQ(read.technique, "gtao");
    EXPECT_EQ(read.preset->name, "high");
    for (const Setting& setting : read.settings) {
        if (setting.name == "falloff") {
            EXPECT_EQ(static_cast<float>(setting.value), third);
        } else {
            EXPECT_EQ(setting.value, setting.name == "slices" ? 3 : 1);
        }
    }
    EXPECT_EQ(read.settings.size(), 3u);
}

} // namespace
} // namespace obscura
