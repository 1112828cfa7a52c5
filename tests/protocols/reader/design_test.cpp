#include "protocols/reader/design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace obscura {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Every key that a protocol can have, twice where two kinds exclude each other.
const std::string everything = R"(name = "small"
title = "Small"
seed = 7
normals = "smooth"

[image]
width = 64
height = 36
antialiasing = 2

[scenes.box]
builtin = "sculpture"
radius = 0.2
exposure = 0.5
camera = { position = [0, 1, 3], target = [0, 0.5, 0], up = [0, 1, 0], fovDegrees = 40, near = 0.1 }
[scenes.hall]
file = "hall.glb"
radius = 0.3
ground = { wall = -3, colour = [0.9, 0.8, 0.7] }
camera = { position = [0, 1, 3], target = [0, 0.5, 0] }
[scenes.spare]
file = "spare.glb"
radius = 0.4
camera = { position = [0, 1, 3], target = [0, 0.5, 0] }

[levels.low]
ambient = [1, 1, 1]
background = [0.5, 1, 1]
[levels.middle]
environment = "sky.hdr"
[levels.high]
sky = { zenith = [0.2, 0.4, 0.8], horizon = [0.3, 1, 1], ground = [0.4, 0, 0] }
sun = { azimuthDegrees = 30, elevationDegrees = 50, irradiance = [3, 2, 1] }
curve = "reinhard"
white = 5
occludeDirect = false
sceneLights = false
[levels.unused]
ambient = [0.25, 1, 1]

[techniques.none]
technique = "none"
[techniques.blizzard24]
technique = "blizzard"
preset = "fine"
samples = 24
[techniques.idle]
technique = "crytek"
samples = 9

[[conditions]]
id = "one"
scene = "box"
level = "low"
pair = ["none", "blizzard24"]
hypothesis = "H1"
simulatedPreference = 0.7
[[conditions]]
id = "two"
scene = "hall"
level = "middle"
pair = ["none", "blizzard24"]
[[conditions]]
id = "three"
scene = "hall"
level = "high"
pair = ["none", "blizzard24"]

[trial]
mask = 2.0
grey = 128
minimumView = 1

[ordering]
scheme = "thesis"
participants = 28

[texts]
instructions = "Look."
start = "Start"
question = "Which?"
first = "first"
second = "second"
thanks = "Thanks"

[display]
name = "standard_4k"
peak = 150

[simulation]
positionBias = 0.01
lapse = 0.015
view = { mean = 3.1, deviation = 0.81, tail = 2.1 }
decision = { mean = 0.91, deviation = 0.21, tail = 0.51 }
)";

std::string with(const std::string& from, const std::string& to) {
    std::string text = everything;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from << " stands twice";
    return text.replace(at, from.size(), to);
}

ProtocolParts parts(const std::string& text) { return partsOf(parseProtocol(text, "small.toml")); }

enum class Part { stimuli, procedure, texts };

struct Turn {
    const char* from;
    const char* to;
    Part part;
};
void PrintTo(const Turn& turn, std::ostream* out) { *out << turn.from << " -> " << turn.to; }

// Each key turned, and the one part that must change. (A field that a struct gains does not even
// compile before design.cpp knows it.)
const Turn turns[] = {
    {"seed = 7", "seed = 8", Part::stimuli},
    {"normals = \"smooth\"", "normals = \"face\"", Part::stimuli},
    {"width = 64", "width = 65", Part::stimuli},
    {"height = 36", "height = 37", Part::stimuli},
    {"antialiasing = 2", "antialiasing = 3", Part::stimuli},
    {"builtin = \"sculpture\"", "builtin = \"atrium\"", Part::stimuli},
    {"radius = 0.2", "radius = 0.21", Part::stimuli},
    {"exposure = 0.5", "exposure = 0.6", Part::stimuli},
    {"fovDegrees = 40", "fovDegrees = 41", Part::stimuli},
    {"near = 0.1", "near = 0.2", Part::stimuli},
    {"up = [0, 1, 0]", "up = [0, 1, 0.1]", Part::stimuli},
    {"position = [0, 1, 3], target = [0, 0.5, 0], up",
     "position = [0, 1, 4], target = [0, 0.5, 0], up", Part::stimuli},
    {"target = [0, 0.5, 0], up", "target = [0, 0.6, 0], up", Part::stimuli},
    {"hall.glb", "halls.glb", Part::stimuli},
    {"wall = -3", "wall = -4", Part::stimuli},
    {"colour = [0.9", "colour = [0.8", Part::stimuli},
    {"ambient = [1, 1, 1]", "ambient = [1, 1, 0.9]", Part::stimuli},
    {"background = [0.5, 1, 1]", "background = [0.6, 1, 1]", Part::stimuli},
    {"sky.hdr", "skies.hdr", Part::stimuli},
    {"zenith = [0.2", "zenith = [0.3", Part::stimuli},
    {"horizon = [0.3", "horizon = [0.2", Part::stimuli},
    {"ground = [0.4", "ground = [0.3", Part::stimuli},
    {"azimuthDegrees = 30", "azimuthDegrees = 31", Part::stimuli},
    {"elevationDegrees = 50", "elevationDegrees = 51", Part::stimuli},
    {"irradiance = [3", "irradiance = [2", Part::stimuli},
    {"curve = \"reinhard\"", "curve = \"clamp\"", Part::stimuli},
    {"curve = \"reinhard\"", "curve = \"aces\"", Part::stimuli},
    {"curve = \"reinhard\"", "curve = \"neutral\"", Part::stimuli},
    {"sceneLights = false", "sceneLights = true", Part::stimuli},
    {"white = 5", "white = 6", Part::stimuli},
    {"occludeDirect = false", "occludeDirect = true", Part::stimuli},
    {"technique = \"blizzard\"", "technique = \"crytek\"", Part::stimuli},
    {"preset = \"fine\"", "preset = \"coarse\"", Part::stimuli},
    {"samples = 24", "samples = 25", Part::stimuli},
    {"hypothesis = \"H1\"", "hypothesis = \"H2\"", Part::stimuli},
    {"mask = 2.0", "mask = 2.1", Part::procedure},
    {"grey = 128", "grey = 127", Part::procedure},
    {"minimumView = 1", "minimumView = 0.9", Part::procedure},
    {"title = \"Small\"", "title = \"A small one\"", Part::texts},
    {"name = \"small\"", "name = \"smaller\"", Part::texts},
    {"participants = 28", "participants = 29", Part::texts},
    {"Look.", "Look!", Part::texts},
    {"\"Start\"", "\"Begin\"", Part::texts},
    {"Which?", "Which one?", Part::texts},
    {"first = \"first\"", "first = \"1st\"", Part::texts},
    {"second = \"second\"", "second = \"2nd\"", Part::texts},
    {"Thanks", "Bye", Part::texts},
    {"simulatedPreference = 0.7", "simulatedPreference = 0.8", Part::texts},
    {"standard_4k", "laptop", Part::texts},
    {"peak = 150", "contrast = 150", Part::texts},
    {"positionBias = 0.01", "positionBias = 0.02", Part::texts},
    {"lapse = 0.015", "lapse = 0.016", Part::texts},
    {"mean = 3.1", "mean = 3.2", Part::texts},
    {"deviation = 0.81", "deviation = 0.82", Part::texts},
    {"tail = 2.1", "tail = 2.2", Part::texts},
    {"mean = 0.91", "mean = 0.92", Part::texts},
    {"deviation = 0.21", "deviation = 0.22", Part::texts},
    {"tail = 0.51", "tail = 0.52", Part::texts},
    // used by no condition
    {"spare.glb", "other.glb", Part::texts},
    {"ambient = [0.25", "ambient = [0.3", Part::texts},
    {"samples = 9", "samples = 10", Part::texts},
};

class DesignTurn : public testing::TestWithParam<Turn> {};

TEST_P(DesignTurn, ChangesOnePart) {
    const Turn& turn = GetParam();
    const ProtocolParts before = parts(everything), now = parts(with(turn.from, turn.to));
    EXPECT_EQ(now.stimuli != before.stimuli, turn.part == Part::stimuli);
    EXPECT_EQ(now.procedure != before.procedure, turn.part == Part::procedure);
    EXPECT_EQ(now.texts != before.texts, turn.part == Part::texts);
}

INSTANTIATE_TEST_SUITE_P(Design, DesignTurn, testing::ValuesIn(turns));

// What a condition no longer uses moves to the texts.
TEST(Design, AConditionsSceneLevelAndPairArePartOfIt) {
    const std::string before = designOf(parseProtocol(everything, "small.toml"));
    for (const auto& [from, to] : {std::pair("level = \"high\"", "level = \"low\""),
                                   std::pair("scene = \"box\"", "scene = \"hall\""),
                                   std::pair("pair = [\"none\", \"blizzard24\"]\nhypothesis",
                                             "pair = [\"idle\", \"blizzard24\"]\nhypothesis")})
        EXPECT_NE(designOf(parseProtocol(with(from, to), "small.toml")), before) << from;
}

TEST(Design, IsNotChangedByCommentsSpellingOrUnwrittenDefaults) {
    const ProtocolParts before = parts(everything);
    const ProtocolParts now = parts("# A remark.\n\n" + with("mask = 2.0\n", ""));
    EXPECT_EQ(now.stimuli, before.stimuli);
    EXPECT_EQ(now.procedure, before.procedure);
    EXPECT_EQ(now.texts, before.texts);
}

TEST(Design, AnotherOrderOfConditionsNeedsNoOtherStimuli) {
    std::string text = with("id = \"one\"", "id = \"x\"");
    text.replace(text.find("id = \"three\""), 12, "id = \"one\"");
    text.replace(text.find("id = \"x\""), 8, "id = \"three\"");
    // Exchanged ids are other pictures; exchanged places are not.
    EXPECT_NE(parts(text).stimuli, parts(everything).stimuli);

    const std::size_t two = everything.find("[[conditions]]\nid = \"two\""),
                      three = everything.find("[[conditions]]\nid = \"three\""),
                      end = everything.find("\n[trial]");
    const std::string moved = everything.substr(0, two) + everything.substr(three, end - three) +
                              everything.substr(two, three - two) + everything.substr(end);
    EXPECT_EQ(parts(moved).stimuli, parts(everything).stimuli);
    EXPECT_NE(parts(moved).procedure, parts(everything).procedure);
}

TEST(Design, DifferencesAreNamedByTheProtocolsKeys) {
    const auto design = [](const std::string& text) {
        return designOf(parseProtocol(text, "small.toml"));
    };
    const std::string before = design(everything);
    EXPECT_THAT(differences(before, design(with("mask = 2.0", "mask = 3"))),
                ElementsAre("trial.mask was 2, is now 3"));
    EXPECT_THAT(differences(before, design(with("samples = 24", "samples = 8\nradius = 1.5"))),
                ElementsAre("techniques.blizzard24.radius is new",
                            "techniques.blizzard24.samples was 24, is now 8"));
    const std::size_t third = everything.find("[[conditions]]\nid = \"three\"");
    std::string fewer = everything;
    fewer.erase(third, everything.find("\n[trial]") - third);
    EXPECT_THAT(differences(before, design(fewer)),
                ElementsAre("conditions.three is gone", "levels.high is gone",
                            "order of conditions was [\"one\",\"two\",\"three\"], is now "
                            "[\"one\",\"two\"]"));
    EXPECT_THAT(differences(before, before), testing::IsEmpty());
}

} // namespace
} // namespace obscura
