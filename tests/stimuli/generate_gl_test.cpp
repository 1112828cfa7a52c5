#include "protocols/files.h"
#include "renderer/gl/context.h"
#include "renderer/light.h"
#include "stimuli/generate.h"
#include "stimuli/plan.h"
#include "tests/renderer/small_gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>

namespace obscura {
namespace {

namespace fs = std::filesystem;

// Two conditions on one triangle in front of its own mirrored copy: small, but through everything.
std::string protocolText(const std::string& samples = "8", const std::string& sun = "60") {
    return R"(name = "tiny"
seed = 3
image = { width = 64, height = 36, antialiasing = 2 }
[scenes.triangle]
file = "t.gltf"
radius = 0.3
camera = { position = [0.4, 0.5, 1.5], target = [0.3, 0.3, 0], fovDegrees = 50 }
[levels.low]
ambient = [1, 1, 1]
[levels.high]
sky = {}
sun = { azimuthDegrees = 20, elevationDegrees = )" +
           sun + R"( }
[techniques.none]
technique = "none"
[techniques.crytek]
technique = "crytek"
[techniques.few]
technique = "blizzard"
samples = )" +
           samples + R"(
[[conditions]]
id = "first"
scene = "triangle"
level = "low"
pair = ["crytek", "few"]
[[conditions]]
id = "second"
scene = "triangle"
level = "high"
pair = ["none", "few"]
[texts]
instructions = "i"
start = "s"
question = "q"
first = "1"
second = "2"
thanks = "t"
)";
}

// By hash: a difference is to be named, not printed.
std::map<std::string, std::string> contentsOf(const fs::path& folder) {
    std::map<std::string, std::string> result;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        result[entry.path().filename().string()] = sha256File(entry.path());
    return result;
}

class Generate : public testing::Test {
  protected:
    static void SetUpTestSuite() { context_ = std::make_unique<gl::Context>(); }
    static void TearDownTestSuite() { context_.reset(); }
    void SetUp() override {
        root_ = fs::path(testing::TempDir()) /
                (std::string("obscura_generate_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(root_);
        writeFile(root_ / "scenes" / "t.bin", triangleBuffer());
        writeFile(root_ / "scenes" / "t.gltf", triangleGltf("", R"(,"doubleSided":true)"));
    }
    GenerateResult run(const std::string& text = protocolText(), const std::string& folder = "out",
                       bool layers = false, const Announce& announce = quiet) {
        return generate(parseProtocol(text, "tiny.toml"), folders(), root_ / folder, layers,
                        context_->driver(), announce);
    }
    Folders folders() const { return {root_ / "scenes", root_}; }

    inline static const Announce quiet = [](int, int, const std::string&) {};
    inline static std::unique_ptr<gl::Context> context_;
    fs::path root_;
};

TEST_F(Generate, WritesMatchedPairs) {
    const GenerateResult result = run();
    EXPECT_EQ(result.rendered, 4);
    const Manifest manifest = readManifest(root_ / "out" / "manifest.json");
    ASSERT_EQ(manifest.pairs.size(), 2u);
    EXPECT_EQ(manifest.pairs[0].condition, "first");
    for (const PairRecord& pair : manifest.pairs) {
        EXPECT_EQ(pair.a.inputsSha256, pair.b.inputsSha256);
        EXPECT_NE(pair.a.recipe.technique, pair.b.recipe.technique);
        for (const ImageRecord& image : {pair.a, pair.b}) {
            EXPECT_EQ(sha256File(root_ / "out" / image.image.path), image.image.sha256);
            EXPECT_TRUE(image.layers.contains("ao"));
            EXPECT_EQ(image.recipe.settings.contains("radius"), image.recipe.technique != "none");
        }
    }
    EXPECT_NE(manifest.pairs[0].a.inputsSha256, manifest.pairs[1].a.inputsSha256); // levels differ
    EXPECT_EQ(manifest.pairs[1].a.meanOcclusion, 0);
    EXPECT_GT(manifest.pairs[0].a.meanOcclusion, 0.1); // Crytek on a plane
    EXPECT_TRUE(fs::exists(root_ / "out" / manifest.contactSheet.path));
    EXPECT_FALSE(fs::exists(root_ / "out" / "unfinished-manifest.json"));
}

TEST_F(Generate, TwoRunsGiveIdenticalBytes) {
    run(protocolText(), "one", true);
    run(protocolText(), "two", true);
    EXPECT_EQ(contentsOf(root_ / "one"), contentsOf(root_ / "two"));
}

TEST_F(Generate, KeepsWhatTheManifestProves) {
    run();
    const auto before = contentsOf(root_ / "out");
    const GenerateResult again = run();
    EXPECT_EQ(again.rendered, 0);
    EXPECT_EQ(again.kept, 4);
    EXPECT_EQ(contentsOf(root_ / "out"), before);
}

TEST_F(Generate, RendersAgainWhatASettingConcerns) {
    run();
    EXPECT_EQ(run(protocolText("9")).rendered, 2);       // both images of "few"
    EXPECT_EQ(run(protocolText("9", "70")).rendered, 2); // both images of level high
}

TEST_F(Generate, RendersAgainWhatWasTouchedOrLost) {
    const std::string image = run().manifest.pairs[0].a.image.path;
    writeFile(root_ / "out" / image, "not the image");
    EXPECT_EQ(run().rendered, 1);
    fs::remove(root_ / "out" / image);
    EXPECT_EQ(run().rendered, 1);
}

TEST_F(Generate, RendersAgainWhenTheSceneChanges) {
    run();
    std::string bytes = triangleBuffer();
    bytes[14] = '\x40'; // another corner
    writeFile(root_ / "scenes" / "t.bin", bytes);
    EXPECT_EQ(run().rendered, 4);
}

// The built-in sky, stored as an image: a file must light the scene as the sky does.
TEST_F(Generate, AnEnvironmentImageLightsLikeTheSkyItShows) {
    const std::array<std::string, 3> names{"R", "G", "B"};
    writeExr(root_ / "sky.exr", skyPanorama(Sky{}), names, true);
    std::string text = protocolText();
    text.replace(text.find("sky = {}"), 8, "environment = \"sky.exr\"");
    const GenerateResult sky = run(protocolText(), "sky"), image = run(text, "image");
    const auto lit = [&](const GenerateResult& result) {
        const fs::path path = result.manifest.folder / result.manifest.pairs[1].b.image.path;
        return readImage8(path).pixels;
    };
    EXPECT_EQ(lit(sky), lit(image));

    Image dusk = skyPanorama(Sky{});
    for (float& value : dusk.pixels)
        value *= 0.25f;
    writeExr(root_ / "sky.exr", dusk, names, true);
    const GenerateResult darker = run(text, "image");
    EXPECT_EQ(darker.rendered, 2); // the level that it lights
    EXPECT_NE(lit(darker), lit(sky));
}

TEST_F(Generate, LayersAreAddedOnRequest) {
    run();
    EXPECT_EQ(run(protocolText(), "out", true).rendered, 4);
    const Manifest manifest = readManifest(root_ / "out" / "manifest.json");
    for (const char* layer : {"ao", "visibility", "linear", "albedo", "depth"})
        EXPECT_TRUE(manifest.pairs[0].a.layers.contains(layer)) << layer;
    // A constant light and a technique of depth alone: nobody asks for normals, so there are none.
    EXPECT_FALSE(manifest.pairs[0].a.layers.contains("occlusion-normal"));
    EXPECT_TRUE(manifest.pairs[0].b.layers.contains("occlusion-normal"));
}

TEST_F(Generate, AnInterruptedRunLeavesNothingHalfDone) {
    const Announce interrupt = [](int done, int, const std::string&) {
        if (done == 3)
            throw std::runtime_error("power cut");
    };
    EXPECT_THROW(run(protocolText(), "out", false, interrupt), std::runtime_error);
    EXPECT_FALSE(fs::exists(root_ / "out" / "manifest.json"));
    for (const auto& [name, content] : contentsOf(root_ / "out"))
        EXPECT_NE(name.front(), '.') << "an unfinished file was left: " << name;
    writeFile(root_ / "out" / ".first_a_crytek.123.png", "what a killed run leaves");
    const GenerateResult rest = run();
    EXPECT_FALSE(fs::exists(root_ / "out" / ".first_a_crytek.123.png"));
    EXPECT_EQ(rest.kept, 2); // the finished pair
    EXPECT_EQ(rest.rendered, 2);
}

TEST_F(Generate, APairThatIsNotMatchedIsRefused) {
    run();
    const fs::path path = root_ / "out" / "manifest.json";
    Manifest manifest = readManifest(path);
    manifest.pairs[0].a.inputsSha256 = std::string(64, '0');
    writeManifest(path, manifest);
    try {
        run();
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("tiny.toml:20:1: conditions[1]: the pair is "
                                                     "not matched: before occlusion, \"crytek\""));
    }
}

TEST_F(Generate, EveryImageCanBeMadeAgainFromItsRecipeAlone) {
    run();
    const Manifest manifest = readManifest(root_ / "out" / "manifest.json");
    EXPECT_NO_THROW(verify(manifest, folders(), context_->driver(), quiet));
    writeFile(root_ / "out" / manifest.pairs[1].b.image.path, "touched");
    EXPECT_THROW(verify(manifest, folders(), context_->driver(), quiet), Error);
}

TEST_F(Generate, VerifyingNoticesAnotherRecipe) {
    run();
    Manifest manifest = readManifest(root_ / "out" / "manifest.json");
    manifest.pairs[0].b.recipe.settings["samples"] = 1;
    try {
        verify(manifest, folders(), context_->driver(), quiet);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("its recipe now gives other pixels"));
    }
}

// Never a silent difference between a scene and its image.
TEST_F(Generate, TellsWhatASceneUsesAndWeDoNotShow) {
    EXPECT_THAT(run().warnings, testing::IsEmpty());
    writeFile(root_ / "scenes" / "t.gltf", triangleGltf("", R"(,"alphaMode":"BLEND")"));
    EXPECT_THAT(run().warnings,
                testing::ElementsAre(
                    "scene \"triangle\": material \"m\" is translucent; it is drawn opaque"));
}

TEST_F(Generate, AMissingSceneNamesItsFile) {
    std::string text = protocolText();
    text.replace(text.find("t.gltf"), 6, "x.gltf");
    try {
        run(text);
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("x.gltf"));
    }
}

TEST(Plan, LoadsEachSceneAndLightingOnce) {
    const Protocol protocol = readProtocol(OBSCURA_SOURCE "/protocols/aalborg-2010.toml");
    const std::vector<PlannedImage> images = plan(protocol);
    ASSERT_EQ(images.size(), 14u);
    std::vector<std::string> loads;
    for (const PlannedImage& image : images) {
        const Condition& condition = protocol.conditions[image.condition];
        const std::string load = condition.view + "/" + condition.level;
        if (loads.empty() || loads.back() != load)
            loads.push_back(load);
    }
    EXPECT_EQ(loads.size(), 5u); // five distinct scenes and levels among seven conditions
}

} // namespace
} // namespace obscura
