#include "base/files.h"
#include "bench/choose/study_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::HasSubstr;

const std::string given = R"(name = "small"
seed = 7
reference = "uniform"
rays = 32
normals = "mapped"
radii = [0.2, 0.35]
train = ["front"]
test = ["left", "far"]
sizes = [[64, 36], [128, 72]]
frames = 3
seconds = 0.125
training = { width = 32, height = 18 }
[light]
environment = "sky.hdr"
sun = { azimuthDegrees = 60, elevationDegrees = 33.3 }
occludeDirect = true
[display]
peak = 120
distanceCm = 65
[scenes.front]
builtin = "sculpture"
camera = { position = [0.1, 0.9, 1.7e-3], target = [0, 0.57, 0], fovDegrees = 38, near = 1e-3 }
[scenes.left]
builtin = "sculpture"
exposure = -1.5
camera = { position = [-1.1, 0.8, 1.4], target = [0, 0.55, 0], up = [0, 0.8, 0.6] }
[scenes.far]
file = "a \"b\"/c.gltf"
camera = { position = [-1.1, 0.8, 1.4], target = [0, 0.55, 0] }
[techniques]
none = { technique = "none" }
starcraft = { technique = "starcraft", samples = [64, 8], blur = 0 }
gtao = { technique = "gtao", preset = ["ultra", "low"], radiusMultiplier = 1.5 }
)";

// All that decides a measurement but what the text says is left out: growth and later sizes.
void expectAlike(const SweepStudy& a, const SweepStudy& b) {
    EXPECT_EQ(a.match.name, b.match.name);
    EXPECT_EQ(a.match.seed, b.match.seed);
    EXPECT_EQ(a.match.rays, b.match.rays);
    EXPECT_EQ(a.match.truth, b.match.truth);
    EXPECT_EQ(a.match.normals, b.match.normals);
    EXPECT_EQ(a.match.training.width, b.match.training.width);
    EXPECT_EQ(a.sizes.front().height, b.sizes.front().height);
    EXPECT_EQ(a.frames, b.frames);
    EXPECT_EQ(a.seconds, b.seconds);
    ASSERT_EQ(a.match.test.size(), b.match.test.size());
    for (std::size_t i = 0; i < a.match.test.size(); ++i) {
        const View &one = a.match.test[i], &other = b.match.test[i];
        EXPECT_EQ(one.file, other.file);
        EXPECT_EQ(one.builtin, other.builtin);
        EXPECT_EQ(one.radius, other.radius);
        EXPECT_EQ(one.exposure, other.exposure);
        EXPECT_EQ(one.camera.position, other.camera.position);
        EXPECT_EQ(one.camera.up, other.camera.up);
        EXPECT_EQ(one.camera.fovDegrees, other.camera.fovDegrees);
    }
    EXPECT_EQ(a.match.train.front().camera.near, b.match.train.front().camera.near);
    EXPECT_EQ(a.display, b.display);
    EXPECT_EQ(a.light->sun->elevationDegrees, b.light->sun->elevationDegrees);
    EXPECT_EQ(a.light->occludeDirect, b.light->occludeDirect);
    EXPECT_EQ(a.light->curve, b.light->curve);
}

TEST(StudyFile, WhatIsReadBackIsTheSame) {
    const SweepStudy study = parseSweepStudy(given, "given.toml");
    const std::string text = studyText(study, "/folder");
    const SweepStudy again = parseSweepStudy(text, "written.toml");
    expectAlike(study, again);
    EXPECT_EQ(studyText(again, "/elsewhere"), text);
    EXPECT_EQ(again.match.train.size(), 2u); // at each radius, under a name of its own
    EXPECT_EQ(again.match.train[1].name, "front-0.35");
    EXPECT_EQ(again.light->environment, "/folder/sky.hdr");
    // The same configurations under the same names, in the order in which files have them.
    ASSERT_EQ(again.match.techniques.size(), 5u);
    EXPECT_EQ(again.match.techniques[0].name, "gtao low");
    EXPECT_EQ(again.match.techniques[0].preset->name, "low");
    EXPECT_EQ(again.match.techniques[0].settings[0].value, 1.5);
    EXPECT_EQ(again.match.techniques[3].name, "starcraft samples=64");
    EXPECT_EQ(again.match.techniques[3].settings[1].value, 64);
}

// The study that comes with choose, as it is written: what `sweep` reads.
TEST(StudyFile, OfTheBuiltInStudyIsAStudy) {
    const SweepStudy study = readSweepStudy(OBSCURA_SOURCE "/protocols/sweep-builtin.toml");
    const std::string text = studyText(study, OBSCURA_SOURCE "/protocols");
    expectAlike(study, parseSweepStudy(text, "written.toml"));
    EXPECT_THAT(text, HasSubstr("obscura-bench sweep"));
}

} // namespace
} // namespace obscura
