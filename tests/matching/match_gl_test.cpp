// Matching from end to end, on a corner with a stair in it and few pixels.
#include "base/files.h"
#include "gl/context.h"
#include "matching/match.h"
#include "matching/match_files.h"
#include "renderer/probe.h"
#include "tests/foreign_files.h"
#include "tests/renderer/scene/small_gltf.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// `criterion` is a line; `techniques` are tables; `test` is a camera's position.
std::string studyText(const std::string& criterion, const std::string& techniques,
                      const std::string& test = "[1.6, 1.1, 2.4]") {
    return "name = \"tiny\"\nseed = 2\nrays = 16\n" + criterion + R"(
train = ["front"]
test = ["side"]
image = { width = 64, height = 48 }
[scenes.front]
file = "t.gltf"
radius = 0.4
camera = { position = [2.2, 1.4, 1.8], target = [0.4, 0.3, 0.4], fovDegrees = 38 }
[scenes.side]
file = "t.gltf"
radius = 0.4
camera = { position = )" +
           test + ", target = [0.4, 0.3, 0.4], fovDegrees = 38 }\n" + techniques;
}

const std::string known = R"([techniques.known]
technique = "blizzard_corrected"
radiusMultiplier = 1.6
intensity = 0.7
power = 1.8
)";
const std::string unknown = "[techniques.unknown]\ntechnique = \"blizzard_corrected\"\n";
const std::string crytek = "[techniques.crytek]\ntechnique = \"crytek\"\n";

// Two walls, a floor, and steps along one wall.
std::vector<float> corner() {
    std::vector<float> positions;
    const auto quad = [&](std::array<float, 3> a, std::array<float, 3> b, std::array<float, 3> d) {
        const std::array<float, 3> c{b[0] + d[0] - a[0], b[1] + d[1] - a[1], b[2] + d[2] - a[2]};
        for (const auto& vertex : {a, b, c, a, c, d})
            positions.insert(positions.end(), vertex.begin(), vertex.end());
    };
    quad({0, 0, 0}, {0, 0, 3}, {3, 0, 0});
    quad({0, 0, 0}, {3, 0, 0}, {0, 3, 0});
    quad({0, 0, 0}, {0, 3, 0}, {0, 0, 3});
    for (const float step : {1.0f, 2.0f, 3.0f}) {
        const float x = 1.2f - 0.3f * step, y = 0.2f * step;
        quad({x, y, 0}, {x, y, 2}, {x + 0.3f, y, 0});
        quad({x + 0.3f, y - 0.2f, 0}, {x + 0.3f, y, 0}, {x + 0.3f, y - 0.2f, 2});
    }
    return positions;
}

class Match : public testing::Test {
  protected:
    static void SetUpTestSuite() { context_ = std::make_unique<gl::Context>(); }
    static void TearDownTestSuite() { context_.reset(); }
    void SetUp() override {
        root_ = fs::path(testing::TempDir()) /
                (std::string("obscura_match_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(root_);
        writeFile(root_ / "t.bin", trianglesBuffer(corner()));
        writeFile(root_ / "t.gltf", trianglesGltf(corner()));
        foreign_.emplace(root_ / "out");
    }
    void TearDown() override {
        EXPECT_EQ(foreign_->lost(), ""); // whatever was done
        fs::remove_all(root_);
    }

    MatchResult run(const std::string& text, const std::string& out = "out",
                    const MatchProgress& progress = quiet) {
        const MatchStudy study = parseMatchStudy(text, (root_ / "tiny.toml").string());
        return match(study, {root_, root_}, root_ / out, root_ / "cache", context_->driver(),
                     progress);
    }
    static const MatchRow& row(const MatchedTechnique& technique, bool train,
                               const std::string& stage) {
        return *std::find_if(
            technique.rows.begin(), technique.rows.end(),
            [&](const MatchRow& each) { return each.train == train && each.stage == stage; });
    }

    inline static const MatchProgress quiet = [](double, double, const std::string&) {};
    inline static std::unique_ptr<gl::Context> context_;
    fs::path root_;
    std::optional<test::ForeignFiles> foreign_;
};

// The partner is the technique itself under known settings: they are found again.
TEST_F(Match, RecoversKnownSettings) {
    const MatchResult result = run(studyText("partner = \"known\"", known + unknown));
    ASSERT_EQ(result.techniques.size(), 2u);
    EXPECT_TRUE(result.techniques[0].fitted.empty()); // the partner stays
    const MatchedTechnique& fitted = result.techniques[1];
    EXPECT_NEAR(std::log2(fitted.fitted.at("radiusMultiplier") / 1.6), 0, 0.1);
    EXPECT_NEAR(fitted.fitted.at("intensity"), 0.7, 0.07);
    EXPECT_NEAR(fitted.fitted.at("power"), 1.8, 0.2);
    for (const bool train : {true, false}) {
        EXPECT_LT(row(fitted, train, "matched").error.rmse, 0.012);
        EXPECT_GT(row(fitted, train, "raw").error.rmse, 0.04);
    }
    EXPECT_NEAR(row(fitted, true, "matched").error.bias, 0, 1e-3); // equal mean occlusion
}

// What a row says may be fitted is, unless the study gives it.
TEST_F(Match, FindsTheFalloffOfARowThatLetsIt) {
    const auto marched = [](const std::string& name, const std::string& settings) {
        return "[techniques." + name + "]\ntechnique = \"ray_march\"\n" + settings;
    };
    const MatchResult result = run(studyText(
        "partner = \"near\"",
        marched("near", "attenuation = 0.1\nradiusMultiplier = 1.2\nintensity = 1\npower = 1\n") +
            marched("free", "") + marched("given", "attenuation = 0.35\n")));
    const MatchedTechnique &free = result.techniques[1], &given = result.techniques[2];
    EXPECT_NEAR(std::log2(free.fitted.at("attenuation") / 0.1), 0, 0.5);
    EXPECT_EQ(given.fitted.count("attenuation"), 0u);
    EXPECT_LT(row(free, false, "matched").error.rmse,
              0.5 * row(given, false, "matched").error.rmse);
}

TEST_F(Match, ImprovesOnARayTracedReference) {
    const MatchResult result =
        run(studyText("reference = \"cosine\"\nscores = [\"uniform\"]", crytek + unknown));
    for (const MatchedTechnique& technique : result.techniques) {
        EXPECT_EQ(technique.fitted.size(), 3u);
        const ImageError raw = row(technique, true, "raw").error,
                         matched = row(technique, true, "matched").error;
        EXPECT_LT(matched.rmse, raw.rmse);
        EXPECT_EQ(summaryOf(technique.rows, "uniform", "matched").views, 1); // test alone
    }
    EXPECT_EQ(result.truths.size(), 2u);
    EXPECT_GT(result.truths[1].error.rmse, 0.01); // uniform is not cosine
}

TEST_F(Match, TestViewsDoNotInfluenceTheFit) {
    const std::string criterion = "reference = \"cosine\"";
    const MatchResult one = run(studyText(criterion, crytek), "one"),
                      two = run(studyText(criterion, crytek, "[2.6, 0.8, 1.2]"), "two");
    EXPECT_EQ(one.techniques[0].fitted, two.techniques[0].fitted);
    EXPECT_NE(row(one.techniques[0], false, "matched").error.rmse,
              row(two.techniques[0], false, "matched").error.rmse);
}

// A protocol that includes the fragment renders with the very errors that were reported.
TEST_F(Match, FragmentGivesTheReportedErrors) {
    const MatchResult result = run(studyText("partner = \"known\"", known + crytek));
    const Protocol protocol = parseProtocol(R"(name = "p"
seed = 2
include = ["out/matched.toml"]
[scenes.side]
file = "t.gltf"
radius = 0.4
camera = { position = [1.6, 1.1, 2.4], target = [0.4, 0.3, 0.4], fovDegrees = 38 }
[levels.low]
ambient = [1, 1, 1]
[[conditions]]
id = "one"
scene = "side"
level = "low"
pair = ["known", "crytek"]
[texts]
instructions = "i"
start = "s"
question = "q"
first = "1"
second = "2"
thanks = "t"
)",
                                            (root_ / "p.toml").string());
    const Subject subject(loadSceneOf(protocol.views[0], {root_, root_}));
    const Probe probe(subject, protocol.views[0].camera, 64, 48, protocol.normals, protocol.seed);
    const auto render = [&](const char* name) {
        return probe.visibility(settingsOf(protocol.technique(name), protocol.views[0].radius));
    };
    const ImageError error = imageError(render("crytek"), render("known"), probe.shown());
    const ImageError& reported = row(result.techniques[1], false, "matched").error;
    EXPECT_DOUBLE_EQ(error.rmse, reported.rmse);
    EXPECT_DOUBLE_EQ(error.bias, reported.bias);
    EXPECT_DOUBLE_EQ(error.ssim, reported.ssim);
}

TEST_F(Match, FilesRepeatAndNothingIsHalfWritten) {
    const std::string text = studyText("reference = \"cosine\"", crytek);
    run(text, "one");
    run(text, "two");
    for (const char* name : {"matched.toml", "match.csv", "match.png"})
        EXPECT_EQ(sha256File(root_ / "one" / name), sha256File(root_ / "two" / name)) << name;
    for (const char* out : {"one", "two"})
        for (const auto& entry : fs::recursive_directory_iterator(root_ / out))
            EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
}

TEST_F(Match, KeepsFinishedTechniquesWhenInterrupted) {
    const std::string text = studyText("reference = \"cosine\"", crytek + unknown);
    struct Interrupted {};
    EXPECT_THROW(run(text, "out",
                     [](double, double, const std::string& note) {
                         if (note == "unknown")
                             throw Interrupted();
                     }),
                 Interrupted);
    EXPECT_FALSE(fs::exists(root_ / "out" / "matched.toml"));
    double done = 0, total = 0;
    const MatchResult again = run(text, "out", [&](double d, double t, const std::string&) {
        EXPECT_GE(d, done);
        done = d;
        total = t;
    });
    EXPECT_EQ(again.kept, 1);
    EXPECT_NEAR(done, total, 1e-6);
    EXPECT_EQ(run(text).kept, 2);
    // Another seed is another result.
    std::string other = text;
    other.replace(other.find("seed = 2"), 8, "seed = 3");
    EXPECT_EQ(run(other).kept, 0);
}

TEST_F(Match, WhatCannotBeFittedIsNoted) {
    const MatchResult result =
        run(studyText("reference = \"cosine\"", "[techniques.none]\ntechnique = \"none\"\n"
                                                "[techniques.\"traced, \\\"here\\\"\"]\n"
                                                "technique = \"ray_traced\"\n"));
    EXPECT_EQ(result.techniques[0].note, "has nothing to fit");
    EXPECT_EQ(result.techniques[0].rows.size(), 4u);
    EXPECT_TRUE(result.techniques[1].rows.empty());
    const std::string fragment = readFile(root_ / "out" / "matched.toml");
    EXPECT_NE(fragment.find("[techniques.\"traced, \\\"here\\\"\"]"), std::string::npos)
        << fragment;
}

TEST_F(Match, MistakesShowBeforeTheFirstRay) {
    const auto message = [&](const std::string& techniques) {
        try {
            run(studyText("reference = \"cosine\"", techniques));
        } catch (const Error& error) {
            return std::string(error.what()).substr((root_ / "tiny.toml").string().size());
        }
        return std::string("was accepted");
    };
    EXPECT_EQ(
        message("[techniques.a]\ntechnique = \"cryteck\"\n"),
        ":16:1: techniques.a: expected the id of a technique, found \"cryteck\"; did you mean "
        "\"crytek\"?");
    EXPECT_EQ(message("[techniques.a]\ntechnique = \"crytek\"\nsample = 3\n"),
              ":18:1: techniques.a.sample: technique \"crytek\" has no setting \"sample\"; did you "
              "mean \"samples\"?");
    EXPECT_FALSE(fs::exists(root_ / "cache"));
}

} // namespace
} // namespace obscura
