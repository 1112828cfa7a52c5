#include "protocols/reader/protocol.h"
#include "tests/protocols/reader/protocol_mistakes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace obscura {
namespace {

// A whole, correct study, as short as one can be with everything in it.
const std::string valid = R"(name = "small"
seed = 7

[image]
width = 64
height = 36

[scenes.box]
builtin = "sculpture"
radius = 0.2
camera = { position = [0, 1, 3], target = [0, 0.5, 0], fovDegrees = 40 }

[levels.low]
ambient = [1, 1, 1]

[levels.high]
sky = { zenith = [0.2, 0.4, 0.8] }
sun = { azimuthDegrees = 30, elevationDegrees = 50 }

[techniques.none]
technique = "none"

[techniques.blizzard24]
technique = "blizzard"
samples = 24

[techniques.wide]
technique = "crytek"
radius = 0.5

[[conditions]]
id = "one"
scene = "box"
level = "low"
pair = ["none", "blizzard24"]

[trial]
mask = 2.0
grey = 128

[texts]
instructions = "Look."
start = "Start"
question = "Which?"
first = "first"
second = "second"
thanks = "Thanks"
)";

std::string with(const std::string& from, const std::string& to) {
    std::string text = valid;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(Protocol, ReadsAWholeStudy) {
    const Protocol protocol = parseProtocol(valid, "small.toml");
    EXPECT_EQ(protocol.name, "small");
    EXPECT_EQ(protocol.seed, 7u);
    EXPECT_EQ(protocol.antialiasing, 4);
    EXPECT_EQ(protocol.view("box").camera.fovDegrees, 40);
    EXPECT_TRUE(protocol.level("low").ambient.has_value());
    EXPECT_EQ(protocol.level("high").sun->elevationDegrees, 50);
    EXPECT_EQ(protocol.technique("blizzard24").settings.at(0).value, 24);
    EXPECT_EQ(protocol.conditions.at(0).roles.at(1).technique, "blizzard24");
    EXPECT_EQ(protocol.conditions.at(0).place.line, 31);
    EXPECT_EQ(protocol.sha256.size(), 64u);
}

TEST(Protocol, ReadsAPresetBesideSettings) {
    const Protocol protocol =
        parseProtocol(with("samples = 24", "preset = \"high\"\nsamples = 24"), "small.toml");
    const TechniqueSetting& technique = protocol.technique("blizzard24");
    ASSERT_TRUE(technique.preset.has_value());
    EXPECT_EQ(technique.preset->name, "high");
    EXPECT_EQ(technique.preset->place.line, 25);
    EXPECT_EQ(technique.settings.size(), 1u);
    EXPECT_FALSE(protocol.technique("none").preset.has_value());
}

TEST(Protocol, KeepsTheOrderOfTheFile) {
    const Protocol protocol = parseProtocol(valid, "small.toml");
    std::vector<std::string> names;
    for (const TechniqueSetting& technique : protocol.techniques)
        names.push_back(technique.name);
    EXPECT_THAT(names, testing::ElementsAre("none", "blizzard24", "wide"));
}

TEST(Protocol, TakesUtf8Texts) {
    const Protocol protocol =
        parseProtocol(with("\"Which?\"", "\"Hvilket billede er mest ægte? 図\""), "small.toml");
    EXPECT_EQ(protocol.texts.question, "Hvilket billede er mest ægte? 図");
}

TEST(Protocol, ShippedStudiesAreWell) {
    for (const char* name : {"aalborg-2010", "demo"}) {
        const Protocol protocol =
            readProtocol(std::string(OBSCURA_SOURCE "/protocols/") + name + ".toml");
        EXPECT_EQ(protocol.name, name);
        EXPECT_EQ(protocol.conditions.size(), 7u); // Table 4 of the thesis
        EXPECT_EQ(protocol.trial.mask, 2.0);
        EXPECT_EQ(protocol.trial.minimumView, 0.5);
        EXPECT_EQ(protocol.width, 1280);
        EXPECT_EQ(protocol.height, 720);
    }
}

class ProtocolError : public testing::TestWithParam<Mistake> {};

TEST_P(ProtocolError, NamesPlaceExpectedAndFound) {
    const Mistake& mistake = GetParam();
    try {
        parseProtocol(with(mistake.from, mistake.to), "small.toml");
        FAIL() << "was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()), mistake.message);
    }
}

INSTANTIATE_TEST_SUITE_P(Mistakes, ProtocolError, testing::ValuesIn(mistakes),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace obscura
