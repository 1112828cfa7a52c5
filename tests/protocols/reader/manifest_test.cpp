#include "base/files.h"
#include "protocols/reader/manifest.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace obscura {
namespace {

namespace fs = std::filesystem;

Manifest sample() {
    Manifest manifest;
    manifest.study = "small";
    manifest.title = "A “small” study";
    manifest.protocolSha256 = std::string(64, 'a');
    manifest.commit = "abc";
    manifest.width = 64;
    manifest.height = 36;
    ConditionRecord pair;
    pair.condition = "one";
    pair.level = "high";
    pair.view = "box";
    pair.radius = 0.2;
    pair.image("a").name = "none";
    pair.image("a").recipe.view.builtin = "sculpture";
    pair.image("a").recipe.view.camera.position = {0.1, 1.0 / 3, 3};
    pair.image("a").recipe.view.ground = Ground{-1.5, {0.1, 0.2, 1.0 / 3}};
    pair.image("a").recipe.level.sky = Sky{};
    pair.image("a").recipe.level.sun = Sun{30, 50, {1, 2, 3}};
    pair.image("a").recipe.technique = "none";
    pair.image("a").image = {"a.png", std::string(64, '1')};
    pair.image("b") = pair.image("a");
    pair.images.back().role = "b";
    pair.image("b").recipe.level.sky.reset();
    pair.image("b").recipe.level.sun.reset();
    pair.image("b").recipe.level.ambient = Vec3{1, 1, 1};
    pair.image("b").recipe.level.curve = Curve::neutral;
    pair.image("b").recipe.level.sceneLights = true;
    pair.image("b").recipe.settings = {{"radius", 0.2}, {"samples", 24}};
    pair.image("b").meanOcclusion = 0.125;
    pair.image("b").quality = {0.1 / 3, 9.25, std::string(64, '5')};
    pair.image("b").milliseconds = 1.0 / 3;
    pair.image("b").layers["ao"] = {"b_ao.png", std::string(64, '2')};
    manifest.conditions.push_back(pair);
    manifest.contactSheets = {{"sheet-1.png", std::string(64, '3')},
                              {"sheet-2.png", std::string(64, '4')}};
    manifest.display = displays()[1];
    manifest.timing = {"by a clock", "llvmpipe", "a processor", {{"box", 2.0 / 3}}};
    return manifest;
}

fs::path file() { return fs::path(testing::TempDir()) / "obscura_manifest_test.json"; }

TEST(ManifestTest, WhatIsWrittenIsRead) {
    writeManifest(file(), sample());
    const std::string first = readFile(file());
    const Manifest manifest = readManifest(file());
    writeManifest(file(), manifest);
    EXPECT_EQ(readFile(file()), first); // every field came back, to the last bit
    EXPECT_EQ(manifest.title, "A “small” study");
    EXPECT_EQ(manifest.conditions.at(0).image("a").recipe.view.camera.position[1], 1.0 / 3);
    EXPECT_EQ(manifest.conditions.at(0).image("b").layers.at("ao").path, "b_ao.png");
    EXPECT_EQ(manifest.conditions.at(0).image("b").quality,
              sample().conditions.at(0).image("b").quality);
    EXPECT_EQ(manifest.conditions.at(0).image("b").milliseconds, 1.0 / 3);
    EXPECT_EQ(manifest.timing, sample().timing);
}

// Not only displays of a name, but any distance that [display] can give, to the last bit: what was
// predicted on another display is predicted again.
TEST(ManifestTest, KeepsItsDisplay) {
    std::vector<Display> all = displays();
    for (int millimetres = 300; millimetres < 1000; ++millimetres) {
        Display other = all.front();
        other.name.clear();
        other.distance = (millimetres / 10.0) / 100;
        all.push_back(other);
    }
    for (const Display& display : all) {
        Manifest manifest = sample();
        manifest.display = display;
        writeManifest(file(), manifest);
        EXPECT_EQ(readManifest(file()).display, display) << inWords(display);
    }
}

// Version 3 predicted and measured nothing.
TEST(ManifestTest, WhatVersion3LacksIsAbsent) {
    writeManifest(file(), sample());
    nlohmann::json json = nlohmann::json::parse(readFile(file()));
    json["schemaVersion"] = 3;
    json.erase("display");
    json.erase("timing");
    for (const char* key : {"quality", "milliseconds"})
        json["conditions"][0]["images"]["b"].erase(key);
    writeFile(file(), json.dump());
    const Manifest manifest = readManifest(file());
    EXPECT_EQ(manifest.schemaVersion, 3);
    EXPECT_FALSE(manifest.display);
    EXPECT_FALSE(manifest.timing);
    EXPECT_FALSE(manifest.conditions[0].image("b").quality);
    EXPECT_FALSE(manifest.conditions[0].image("b").milliseconds);
}

// Whatever decides pixels must decide the hash, or a stale image would be kept.
TEST(ManifestTest, EveryPartOfARecipeChangesItsHash) {
    const Recipe base = sample().conditions[0].image("a").recipe;
    const std::vector<std::pair<const char*, void (*)(Recipe&)>> changes = {
        {"width", [](Recipe& r) { r.width = 1; }},
        {"height", [](Recipe& r) { r.height = 1; }},
        {"antialiasing", [](Recipe& r) { r.antialiasing = 9; }},
        {"seed", [](Recipe& r) { r.seed = 9; }},
        {"scene", [](Recipe& r) { r.sceneSha256 = "x"; }},
        {"camera", [](Recipe& r) { r.view.camera.fovDegrees += 1e-9; }},
        {"near", [](Recipe& r) { r.view.camera.near = 1; }},
        {"wall", [](Recipe& r) { r.view.ground->wall = 1; }},
        {"colour", [](Recipe& r) { r.view.ground->colour[1] = 1; }},
        {"exposure", [](Recipe& r) { r.view.exposure = 1; }},
        {"sky", [](Recipe& r) { r.level.sky->ground[2] = 0; }},
        {"sun", [](Recipe& r) { r.level.sun->azimuthDegrees = 0; }},
        {"curve", [](Recipe& r) { r.level.curve = Curve::clamp; }},
        {"another curve", [](Recipe& r) { r.level.curve = Curve::aces; }},
        {"lights", [](Recipe& r) { r.level.sceneLights = true; }},
        {"white", [](Recipe& r) { r.level.white = 9; }},
        {"occludeDirect", [](Recipe& r) { r.level.occludeDirect = true; }},
        {"environment", [](Recipe& r) { r.environmentSha256 = "x"; }},
        {"technique", [](Recipe& r) { r.technique = "x"; }},
        {"settings", [](Recipe& r) { r.settings["radius"] = 1; }},
        {"shaders", [](Recipe& r) { r.shaderSha256 = "x"; }},
        {"code", [](Recipe& r) { r.codeSha256 = "x"; }},
        {"program", [](Recipe& r) { r.programVersion = "x"; }},
        {"driver", [](Recipe& r) { r.glVersion = "x"; }},
    };
    for (const auto& [name, change] : changes) {
        Recipe changed = base;
        change(changed);
        EXPECT_NE(changed.sha256(), base.sha256()) << name;
        EXPECT_EQ(differences(base, changed).size(), 1u) << name;
    }
    EXPECT_EQ(Recipe(base).sha256(), base.sha256());
}

TEST(ManifestTest, NumbersThatDoNotFitAreRefused) {
    writeManifest(file(), sample());
    const std::string well = readFile(file());
    for (const char* number : {"1e300", "1.5", "4294967296", "-2147483649", "true", "9e601"}) {
        std::string text = well;
        const std::string_view width = "\"width\": 64";
        text.replace(text.rfind(width), width.size(), fmt::format("\"width\": {}", number));
        writeFile(file(), text);
        EXPECT_THROW(readManifest(file()), Error) << number;
    }
}

TEST(ManifestTest, ACurveOfALaterVersionIsRefused) {
    writeManifest(file(), sample());
    std::string text = readFile(file());
    text.replace(text.find("\"reinhard\""), 10, "\"filmic\"");
    writeFile(file(), text);
    try {
        readManifest(file());
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("recipe.level.curve: expected one of clamp, "
                                                     "reinhard, aces, neutral, found \"filmic\""));
    }
}

TEST(ManifestTest, AMissingFieldIsNamed) {
    writeManifest(file(), sample());
    std::string text = readFile(file());
    const std::size_t at = text.find("\"meanOcclusion\"");
    writeFile(file(), text.replace(at, 15, "\"meanOclusion\""));
    try {
        readManifest(file());
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(),
                    testing::HasSubstr("conditions[1].images.a.meanOcclusion: expected this key"));
    }
}

TEST(ManifestTest, DifferencesAreSpelt) {
    const Recipe recorded = sample().conditions[0].image("b").recipe;
    Recipe now = recorded;
    now.settings["radius"] = 0.3;
    now.settings.erase("samples");
    now.view.camera.target[2] = 1;
    now.view.camera.fovDegrees += 1e-9;
    EXPECT_THAT(differences(recorded, now),
                testing::ElementsAre("settings.radius: 0.2, now 0.3",
                                     "settings.samples: 24, now none",
                                     "view.camera.fovDegrees: 50.0, now 50.000000001",
                                     "view.camera.target.2: 0, now 1"));
    EXPECT_THAT(differences(now, now), testing::IsEmpty());
}

// Version 2 had pairs, and version 1 no hash of the code.
TEST(ManifestTest, AnEarlierVersionIsRead) {
    writeManifest(file(), sample());
    nlohmann::json json = nlohmann::json::parse(readFile(file()));
    json["schemaVersion"] = 1;
    json["pairs"] = json["conditions"];
    json.erase("conditions");
    for (nlohmann::json& pair : json["pairs"]) {
        pair["a"] = pair["images"]["a"];
        pair["b"] = pair["images"]["b"];
        pair.erase("images");
        for (const char* role : {"a", "b"})
            pair[role]["recipe"].erase("codeSha256");
    }
    writeFile(file(), json.dump());
    const Manifest manifest = readManifest(file());
    EXPECT_EQ(manifest.schemaVersion, 1);
    EXPECT_TRUE(manifest.conditions[0].isPair());
    EXPECT_EQ(manifest.conditions[0].image("a").recipe.codeSha256, "");
    EXPECT_EQ(manifest.conditions[0].image("a").recipe.technique, "none");
}

TEST(ManifestTest, HasImagesOfOtherRoles) {
    Manifest manifest = sample();
    ImageRecord& reference = manifest.conditions[0].image("reference");
    reference = manifest.conditions[0].image("a");
    reference.role = "reference";
    reference.name = "traced";
    writeManifest(file(), manifest);
    const Manifest read = readManifest(file());
    EXPECT_EQ(read.conditions[0].images.size(), 3u);
    EXPECT_EQ(read.conditions[0].image("reference").name, "traced");
    EXPECT_EQ(read.conditions[0].find("c"), nullptr);
}

TEST(ManifestTest, AListMustBeOne) {
    writeManifest(file(), sample());
    const std::string text = readFile(file());
    for (const char* wrong : {"{}", "3", "null", "\"conditions\""}) {
        const std::size_t at = text.find("\"conditions\": ") + 14;
        writeFile(file(), text.substr(0, at) + wrong + "}");
        EXPECT_THROW(readManifest(file()), Error) << wrong;
    }
}

TEST(ManifestTest, AnotherVersionIsRefused) {
    writeFile(file(), R"({"schemaVersion": 99})");
    try {
        readManifest(file());
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("schemaVersion: expected 1 ... 4, found 99"));
    }
}

} // namespace
} // namespace obscura
