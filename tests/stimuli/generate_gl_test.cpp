#include "base/files.h"
#include "gl/context.h"
#include "renderer/frame/light.h"
#include "stimuli/generate.h"
#include "stimuli/plan.h"
#include "tests/error_of.h"
#include "tests/foreign_files.h"
#include "tests/renderer/scene/small_gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
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
        if (entry.is_regular_file()) // not the units
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
                       bool layers = false, const Announce& announce = quiet,
                       std::string_view code = imageCode()) {
        return generate(parseProtocol(text, "tiny.toml"), folders(), root_ / folder, layers,
                        context_->driver(), announce, code);
    }
    int verified(const std::string& text = protocolText(), std::string_view code = imageCode()) {
        return verify(parseProtocol(text, "tiny.toml"),
                      readManifest(root_ / "out" / "manifest.json"), folders(), context_->driver(),
                      quiet, code);
    }
    // What is wrong with the folder out, and that making it anew mends that.
    std::string faultMendedBy(const std::string& text = protocolText()) {
        const std::string fault = test::errorOf([&] { verified(text); });
        run(text);
        EXPECT_NO_THROW(verified(text)) << "after: " << fault;
        return fault;
    }
    std::vector<std::string> checked(const std::string& text) {
        return check(parseProtocol(text, "tiny.toml"), folders(), context_->driver(), quiet);
    }
    // As if the folder were of a program that knew no units.
    void forgetUnits() const { fs::remove_all(root_ / "out" / "units"); }
    // A floor before a wall in place of the triangle, so that rays meet something.
    void makeCorner() const {
        const std::vector<float> corner{-9, 0, 0, 9, 0, 0, 0, 0.6f, 0, -9, 0, 0, 0, 0, 9, 9, 0, 0};
        writeFile(root_ / "scenes" / "t.bin", trianglesBuffer(corner));
        writeFile(root_ / "scenes" / "t.gltf", trianglesGltf(corner));
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
    ASSERT_EQ(manifest.conditions.size(), 2u);
    EXPECT_EQ(manifest.conditions[0].condition, "first");
    for (const ConditionRecord& pair : manifest.conditions) {
        EXPECT_EQ(pair.image("a").inputsSha256, pair.image("b").inputsSha256);
        EXPECT_NE(pair.image("a").recipe.technique, pair.image("b").recipe.technique);
        for (const ImageRecord& image : {pair.image("a"), pair.image("b")}) {
            EXPECT_EQ(sha256File(root_ / "out" / image.image.path), image.image.sha256);
            EXPECT_TRUE(image.layers.contains("ao"));
            EXPECT_EQ(image.recipe.settings.contains("radius"), image.recipe.technique != "none");
        }
    }
    EXPECT_NE(manifest.conditions[0].image("a").inputsSha256,
              manifest.conditions[1].image("a").inputsSha256); // levels differ
    EXPECT_EQ(manifest.conditions[1].image("a").meanOcclusion, 0);
    EXPECT_GT(manifest.conditions[0].image("a").meanOcclusion, 0.1); // Crytek on a plane
    EXPECT_TRUE(fs::exists(root_ / "out" / manifest.contactSheets.at(0).path));
}

// But for how long techniques took.
TEST_F(Generate, TwoRunsGiveIdenticalBytes) {
    for (const char* folder : {"one", "two"}) {
        Manifest manifest = run(protocolText(), folder, true).manifest;
        manifest.timing.reset();
        for (ConditionRecord& condition : manifest.conditions)
            for (ImageRecord& image : condition.images)
                image.milliseconds.reset();
        writeManifest(root_ / folder / "manifest.json", manifest);
    }
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

// As protocolText(), with the reference as a third image of the first condition and the second of
// the other.
std::string tracedText() {
    std::string text = protocolText();
    text.replace(text.find("[techniques.few]"), 0,
                 "[techniques.exact]\ntechnique = \"ray_traced\"\nrays = 256\n");
    text.replace(text.find("pair = [\"crytek\", \"few\"]"), 24,
                 "roles = { a = \"crytek\", b = \"few\", c = \"exact\" }");
    text.replace(text.find("pair = [\"none\", \"few\"]"), 22, "pair = [\"none\", \"exact\"]");
    return text;
}

// Only surfaces differ from an open view, so that the error of `none` follows from the reference's
// picture of visibility, and the number of surfaces from its mean.
TEST_F(Generate, MeasuresHowFarImagesAreFromTheReference) {
    makeCorner();
    const Manifest manifest = run(tracedText()).manifest;
    EXPECT_EQ(manifest.display, displays().front());
    const ConditionRecord &first = manifest.conditions[0], &second = manifest.conditions[1];
    for (const ImageRecord* exact : {&first.image("c"), &second.image("b")}) {
        EXPECT_EQ(exact->quality->rmse, 0);
        EXPECT_EQ(exact->quality->jod, 10);
        EXPECT_EQ(exact->quality->referenceSha256, exact->recipe.sha256());
    }
    const ImageRecord& exact = second.image("b");
    double sum = 0, squares = 0;
    for (const std::uint8_t code :
         readImage8(manifest.folder / exact.layers.at("ao").path, 1).pixels) {
        sum += 1 - code / 255.0;
        squares += std::pow(1 - code / 255.0, 2);
    }
    const double surfaces = sum / exact.meanOcclusion;
    EXPECT_NEAR(second.image("a").quality->rmse, std::sqrt(squares / surfaces), 0.002);
    EXPECT_LT(second.image("a").quality->jod, 9.9);
    EXPECT_GT(first.image("a").quality->rmse, first.image("b").quality->rmse); // Crytek on a plane
}

TEST_F(Generate, TimesTechniquesOfAViewTogether) {
    const Manifest manifest = run(tracedText()).manifest;
    const ConditionRecord &first = manifest.conditions[0], &second = manifest.conditions[1];
    EXPECT_GT(first.image("a").milliseconds, 0);
    EXPECT_GT(first.image("b").milliseconds, 0);
    EXPECT_EQ(second.image("a").milliseconds, 0);
    EXPECT_FALSE(second.image("b").milliseconds); // no passes, and of no interest
    EXPECT_GT(manifest.timing->starcraft.at("triangle"), 0);
    EXPECT_EQ(manifest.timing->renderer, context_->driver().renderer);
    EXPECT_NE(manifest.timing->method, "");
    // An image that is new is no reason to compare times of two days.
    std::string text = protocolText();
    const Manifest before = run(text).manifest;
    text.replace(text.find("[1, 1, 1]"), 9, "[1, 1, 0]"); // of the level that comes last
    const Manifest again = run(text).manifest;
    EXPECT_EQ(again.conditions[0].image("b").milliseconds,
              again.conditions[1].image("b").milliseconds);
    EXPECT_NE(again.conditions[1].image("b").milliseconds,
              before.conditions[1].image("b").milliseconds);
}

// A folder of before there were qualities, or predicted for another display.
TEST_F(Generate, MeasuresImagesThatAreKept) {
    const Manifest made = run().manifest;
    Manifest before = made;
    before.display.reset();
    before.timing.reset();
    for (ConditionRecord& condition : before.conditions)
        for (ImageRecord& image : condition.images) {
            image.quality.reset();
            image.milliseconds.reset();
        }
    writeManifest(root_ / "out" / "manifest.json", before);
    forgetUnits();
    const GenerateResult again = run();
    EXPECT_EQ(again.kept, 4);
    EXPECT_EQ(again.manifest.conditions[0].image("b").quality,
              made.conditions[0].image("b").quality);
    EXPECT_GT(again.manifest.conditions[0].image("b").milliseconds, 0);

    const GenerateResult bright = run(protocolText() + "[display]\npeak = 1000\nambientLux = 0\n");
    EXPECT_EQ(bright.kept, 4);
    EXPECT_EQ(bright.manifest.display->peak, 1000);
    EXPECT_NE(bright.manifest.conditions[0].image("b").quality->jod,
              made.conditions[0].image("b").quality->jod);
    EXPECT_EQ(bright.manifest.conditions[0].image("b").milliseconds,
              again.manifest.conditions[0].image("b").milliseconds);
}

// Rays of one level serve the next, and no others.
TEST_F(Generate, RaysAreTracedOnceForAllLevels) {
    makeCorner();
    const Protocol protocol = parseProtocol(tracedText(), "tiny.toml");
    SceneHashes scenes(folders());
    const Recipe low = makeRecipe(protocol, protocol.conditions[0], 2, scenes, context_->driver()),
                 high = makeRecipe(protocol, protocol.conditions[1], 1, scenes, context_->driver());
    Recipe other = high, near = high;
    other.seed += 1;
    near.settings["radius"] = 0.1;
    RecipeRenderer shared(folders());
    shared.render(low);
    for (const Recipe& recipe : {high, other, near})
        EXPECT_EQ(shared.render(recipe).image.pixels,
                  RecipeRenderer(folders()).render(recipe).image.pixels);
}

TEST_F(Generate, RendersAgainWhatASettingConcerns) {
    run();
    EXPECT_EQ(run(protocolText("9")).rendered, 2);       // both images of "few"
    EXPECT_EQ(run(protocolText("9", "70")).rendered, 2); // both images of level high
}

TEST_F(Generate, RendersAgainWhatWasTouchedOrLost) {
    const std::string image = run().manifest.conditions[0].image("a").image.path;
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
        const fs::path path =
            result.manifest.folder / result.manifest.conditions[1].image("b").image.path;
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
        EXPECT_TRUE(manifest.conditions[0].image("a").layers.contains(layer)) << layer;
    // A constant light and a technique of depth alone: nobody asks for normals, so there are none.
    EXPECT_FALSE(manifest.conditions[0].image("a").layers.contains("occlusion-normal"));
    EXPECT_TRUE(manifest.conditions[0].image("b").layers.contains("occlusion-normal"));
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
    const fs::path abandoned = test::abandonedFile(root_ / "out");
    const GenerateResult rest = run();
    EXPECT_FALSE(fs::exists(abandoned));
    EXPECT_EQ(rest.kept, 2); // the finished pair
    EXPECT_EQ(rest.rendered, 2);
}

// What is proved by no unit is proved by the manifest, and the other way round.
TEST_F(Generate, TheManifestAloneOrTheUnitsAloneKeepImages) {
    run();
    const auto before = contentsOf(root_ / "out");
    forgetUnits();
    EXPECT_EQ(run().rendered, 0);
    EXPECT_EQ(contentsOf(root_ / "out"), before);
    fs::remove(root_ / "out" / "manifest.json");
    EXPECT_EQ(run().rendered, 0);
    EXPECT_EQ(contentsOf(root_ / "out"), before);
}

// The half that another worker finished is not done again, and a reference whose pictures have gone
// is rendered again.
TEST_F(Generate, GoesOnWithWhatOthersFinished) {
    std::string text = tracedText();
    text.replace(text.find("level = \"high\""), 14, "level = \"low\""); // one reference for both
    const Announce interrupt = [](int done, int, const std::string&) {
        if (done == 3)
            throw std::runtime_error("power cut");
    };
    const GenerateResult whole = run(text, "whole");
    EXPECT_THROW(run(text, "out", false, interrupt), std::runtime_error);
    int pictures = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(root_ / "out" / "units"))
        if (entry.path().extension() == ".png") {
            writeFile(entry.path(), "not a picture");
            ++pictures;
        }
    EXPECT_EQ(pictures, 2);
    const GenerateResult rest = run(text);
    EXPECT_EQ(rest.kept, 3);
    EXPECT_EQ(rest.rendered, 2);
    EXPECT_EQ(whole.warnings.size(), 3U);
    EXPECT_THAT(rest.warnings, testing::ElementsAre(whole.warnings.back())); // of its own half
    for (std::size_t i = 0; i < 2; ++i)
        for (const ImageRecord& image : whole.manifest.conditions[i].images) {
            const ImageRecord& other = rest.manifest.conditions[i].image(image.role);
            EXPECT_EQ(other.image.sha256, image.image.sha256) << image.name;
            EXPECT_EQ(other.quality, image.quality) << image.name;
        }
}

TEST_F(Generate, APairThatIsNotMatchedIsRefused) {
    run();
    const fs::path path = root_ / "out" / "manifest.json";
    Manifest manifest = readManifest(path);
    manifest.conditions[0].image("a").inputsSha256 = std::string(64, '0');
    writeManifest(path, manifest);
    forgetUnits();
    try {
        run();
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(),
                    testing::HasSubstr("tiny.toml:20:1: conditions[1]: the images "
                                       "are not matched: before occlusion, \"crytek\""));
    }
}

// Equal recipes give equal images: what renders is part of them.
TEST_F(Generate, RendersAgainWhenTheRenderingCodeChanges) {
    const GenerateResult first = run();
    EXPECT_EQ(first.manifest.conditions[0].image("a").recipe.codeSha256, imageCode());
    EXPECT_EQ(run(protocolText(), "out", false, quiet, "edited").rendered, 4);
    EXPECT_EQ(run(protocolText(), "out", false, quiet, "edited").rendered, 0);
    EXPECT_EQ(verified(protocolText(), "edited"), 0);
    EXPECT_EQ(verified(), 4); // of other code, and the same all the same
}

// Two scenes, of which one has a texture.
TEST_F(Generate, AChangedTextureConcernsItsSceneAlone) {
    const auto texture = [&](std::uint8_t red) {
        writePng(root_ / "scenes" / "x.png", {1, 1, 3, {red, 90, 90}});
    };
    texture(200);
    writeFile(root_ / "scenes" / "textured.gltf",
              triangleGltf("", R"(,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}})",
                           R"(,"textures":[{"source":0}],"images":[{"uri":"x.png"}])"));
    std::string text = protocolText();
    text.replace(text.find("[levels.low]"), 0, R"([scenes.textured]
file = "textured.gltf"
radius = 0.3
camera = { position = [0.4, 0.5, 1.5], target = [0.3, 0.3, 0], fovDegrees = 50 }
)");
    text.replace(text.rfind("scene = \"triangle\""), 18, "scene = \"textured\"");
    const auto before = run(text).manifest;
    texture(90);
    EXPECT_THAT(test::errorOf([&] { verified(text); }),
                testing::HasSubstr("condition \"second\", image a (second_a_none.png) was made by "
                                   "another recipe than the protocol gives now: sceneSha256: "));
    const GenerateResult after = run(text);
    EXPECT_EQ(after.rendered, 2);
    EXPECT_EQ(after.kept, 2);
    EXPECT_NE(after.manifest.conditions[1].image("a").image.sha256,
              before.conditions[1].image("a").image.sha256);
    verified(text);
}

TEST_F(Generate, AManifestWithoutTheCodeProvesNothing) {
    run();
    const fs::path path = root_ / "out" / "manifest.json";
    nlohmann::json json = nlohmann::json::parse(readFile(path));
    json["schemaVersion"] = 1;
    json["pairs"] = json["conditions"];
    json.erase("conditions");
    for (nlohmann::json& pair : json["pairs"]) {
        pair.update(pair["images"]);
        pair.erase("images");
        for (const char* role : {"a", "b"})
            pair[role]["recipe"].erase("codeSha256");
    }
    writeFile(path, json.dump());
    forgetUnits();
    EXPECT_EQ(verified(), 4); // it can still be read and verified
    const GenerateResult again = run();
    EXPECT_EQ(again.rendered, 4);
    EXPECT_THAT(again.warnings,
                testing::Contains(testing::HasSubstr("manifest.json is of version 1")));
}

// Only what is behind the camera's centre differs: a wall that fills the image, nearer and farther,
// in the same constant light. Its depth alone tells the inputs apart.
TEST_F(Generate, DepthIsPartOfWhatMustMatch) {
    const std::vector<float> wall{-9, -9, 0, 9, -9, 0, 0, 9, 0};
    writeFile(root_ / "scenes" / "t.bin", trianglesBuffer(wall));
    writeFile(root_ / "scenes" / "t.gltf", trianglesGltf(wall));
    const Protocol protocol = parseProtocol(protocolText(), "tiny.toml");
    SceneHashes scenes(folders());
    RecipeRenderer renderer(folders());
    Recipe recipe = makeRecipe(protocol, protocol.conditions[0], 0, scenes, context_->driver());
    recipe.technique = "none";
    recipe.settings.clear();
    recipe.view.camera.position = {0, 0, 1};
    recipe.view.camera.target = {0, 0, 0};
    const Rendering near = renderer.render(recipe);
    const Rendering same = renderer.render(recipe);
    recipe.view.camera.position = {0, 0, 1.25};
    const Rendering far = renderer.render(recipe);
    EXPECT_EQ(near.image.pixels, far.image.pixels);
    EXPECT_EQ(near.inputsSha256, same.inputsSha256);
    EXPECT_NE(near.inputsSha256, far.inputsSha256);
}

// Two scenes that are alike in all but the light that they send by themselves.
TEST_F(Generate, EmissionIsPartOfWhatMustMatch) {
    const std::vector<float> wall{-9, -9, 0, 9, -9, 0, 0, 9, 0};
    writeFile(root_ / "scenes" / "t.bin", trianglesBuffer(wall));
    const Protocol protocol = parseProtocol(protocolText(), "tiny.toml");
    const auto inputs = [&](const std::string& emission) {
        std::string text = trianglesGltf(wall);
        const std::string before = "\"doubleSided\":true";
        text.replace(text.find(before), before.size(), before + ",\"emissiveFactor\":" + emission);
        writeFile(root_ / "scenes" / "t.gltf", text);
        SceneHashes scenes(folders());
        Recipe recipe = makeRecipe(protocol, protocol.conditions[0], 0, scenes, context_->driver());
        recipe.technique = "none";
        recipe.settings.clear();
        recipe.view.camera.position = {0, 0, 1};
        recipe.view.camera.target = {0, 0, 0};
        return RecipeRenderer(folders()).render(recipe).inputsSha256;
    };
    EXPECT_EQ(inputs("[0.1,0,0]"), inputs("[0.1,0.0,0]"));
    EXPECT_NE(inputs("[0.1,0,0]"), inputs("[0.1,0.1,0]"));
}

TEST_F(Generate, EveryImageCanBeMadeAgainFromItsRecipeAlone) {
    Manifest manifest = run().manifest;
    manifest.conditions[0].image("b").milliseconds = 1e6; // decides nothing
    writeManifest(root_ / "out" / "manifest.json", manifest);
    EXPECT_EQ(verified(), 0);
}

TEST_F(Generate, VerifyingNoticesEveryFileThatChanged) {
    run(protocolText(), "out", true);
    const Manifest manifest = readManifest(root_ / "out" / "manifest.json");
    std::vector<std::string> files{manifest.contactSheets.at(0).path,
                                   manifest.conditions[1].image("b").image.path};
    for (const auto& [kind, file] : manifest.conditions[0].image("b").layers)
        files.push_back(file.path);
    EXPECT_GE(files.size(), 7u);
    for (const std::string& file : files) {
        writeFile(root_ / "out" / file, readFile(root_ / "out" / file) + " ");
        EXPECT_THAT(faultMendedBy(), testing::HasSubstr(file + ": has changed since it was made"));
        fs::remove(root_ / "out" / file);
        EXPECT_THAT(faultMendedBy(), testing::HasSubstr(file + ": is missing"));
    }
}

// Also when the manifest was made to agree.
TEST_F(Generate, VerifyingRendersEveryLayerAgain) {
    run(protocolText(), "out", true);
    const fs::path path = root_ / "out" / "manifest.json";
    const Manifest manifest = readManifest(path);
    for (const auto& [kind, layer] : manifest.conditions[0].image("b").layers) {
        const std::string whole = readFile(root_ / "out" / layer.path);
        const std::string& other = manifest.conditions[1].image("b").layers.at(kind).path;
        writeFile(root_ / "out" / layer.path, readFile(root_ / "out" / other));
        Manifest forged = manifest;
        forged.conditions[0].image("b").layers[kind].sha256 = sha256File(root_ / "out" / other);
        writeManifest(path, forged);
        if (layer.sha256 != forged.conditions[0].image("b").layers[kind].sha256) {
            EXPECT_THAT(test::errorOf([&] { verified(); }),
                        testing::HasSubstr("its recipe now gives other pixels"))
                << kind;
        }
        writeFile(root_ / "out" / layer.path, whole);
    }
}

TEST_F(Generate, VerifyingNoticesAnotherProtocol) {
    run();
    const auto with = [](const std::string& from, const std::string& to) {
        std::string text = protocolText();
        return text.replace(text.find(from), from.size(), to);
    };
    const std::vector<std::array<std::string, 3>> changes{
        {"radius = 0.3", "radius = 0.4", "view.radius: 0.3, now 0.4"},
        {"radius = 0.3", "radius = 0.5", "settings.radius: 0.3, now 0.5"},
        {"samples = 8", "samples = 9", "settings.samples: 8, now 9"},
        {"[0.4, 0.5, 1.5]", "[0.4, 0.5, 1.25]", "view.camera.position.2: 1.5, now 1.25"},
        {"seed = 3", "seed = 4", "seed: 3, now 4"},
        {"width = 64", "width = 32", "width: 64, now 32"},
        {"antialiasing = 2", "antialiasing = 1", "antialiasing: 2, now 1"},
        {"seed = 3", "seed = 3\nnormals = \"face\"", "normals: \"smooth\", now \"face\""},
        {"elevationDegrees = 60", "elevationDegrees = 50", "level.sun.elevationDegrees"},
        {"sky = {}", "sky = { zenith = [1, 1, 1] }", "level.sky.zenith.0: 0.25, now 1"},
        {"\"none\", \"few\"", "\"crytek\", \"few\"", "technique: \"none\", now \"crytek\""},
        {"id = \"second\"", "id = \"third\"", "condition \"third\" has no stimuli"},
        {"name = \"tiny\"", "name = \"teeny\"", "is of the study \"tiny\""}};
    for (const auto& [from, to, difference] : changes) {
        const std::string fault = faultMendedBy(with(from, to));
        run();
        EXPECT_THAT(fault, testing::HasSubstr(difference)) << to;
        EXPECT_THAT(fault, testing::HasSubstr("make the stimuli anew")) << to;
    }
}

TEST_F(Generate, VerifyingAnswersForTheConditionAndItsLine) {
    run();
    std::string text = protocolText();
    text.replace(text.find("samples = 8"), 11, "samples = 9");
    EXPECT_THAT(test::errorOf([&] { verified(text); }),
                testing::AllOf(testing::StartsWith("tiny.toml:20:1: conditions[1]: condition "
                                                   "\"first\", image b (first_b_few.png)"),
                               testing::HasSubstr("settings.samples: 8, now 9; make")));
}

TEST_F(Generate, ForeignFilesSurvive) {
    const test::ForeignFiles foreign(root_ / "out");
    run(protocolText(), "out", true);
    EXPECT_EQ(foreign.lost(), "");
    run(protocolText("9"));
    checked(protocolText());
    verified(protocolText("9"));
    EXPECT_EQ(foreign.lost(), "");
}

// --check loads what generation would load, and a mistake is told with the line that names the
// file.
TEST_F(Generate, CheckingLoadsScenesAndEnvironments) {
    EXPECT_NO_THROW(checked(protocolText()));
    std::string text = protocolText();
    const auto faultOf = [&](const std::string& protocol) {
        const std::string fault = test::errorOf([&] { checked(protocol); });
        EXPECT_EQ(test::errorOf([&] { run(protocol); }), fault) << "generation says the same";
        return fault;
    };
    using testing::AllOf, testing::HasSubstr, testing::StartsWith;
    const auto atScene = StartsWith("tiny.toml:4:1: scenes.triangle: ");
    std::string missing = text;
    missing.replace(missing.find("t.gltf"), 6, "x.gltf");
    EXPECT_THAT(faultOf(missing), AllOf(atScene, HasSubstr("x.gltf: expected a glTF scene")));
    writePng(root_ / "scenes" / "x.png", {1, 1, 3, {1, 2, 3}});
    const std::string png = readFile(root_ / "scenes" / "x.png");
    writeFile(root_ / "scenes" / "x.png", png.substr(0, png.size() / 2));
    writeFile(root_ / "scenes" / "x.gltf",
              triangleGltf("", R"(,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}})",
                           R"(,"textures":[{"source":0}],"images":[{"uri":"x.png"}])"));
    EXPECT_THAT(faultOf(missing), AllOf(atScene, HasSubstr("x.png")));

    const auto atLevel = StartsWith("tiny.toml:10:1: levels.high: ");
    std::string lit = text;
    lit.replace(lit.find("sky = {}"), 8, "environment = \"sky.exr\"");
    EXPECT_THAT(faultOf(lit), AllOf(atLevel, HasSubstr("sky.exr: cannot be read: No such file")));
    writeFile(root_ / "sky.exr", "not an image");
    EXPECT_THAT(faultOf(lit), AllOf(atLevel, HasSubstr("sky.exr: expected an image")));
    fs::remove(root_ / "sky.exr");
    fs::create_directory(root_ / "sky.exr");
    EXPECT_THAT(faultOf(lit), AllOf(atLevel, HasSubstr("sky.exr")));
}

// Never a silent difference between a scene and its image.
TEST_F(Generate, TellsWhatASceneUsesAndWeDoNotShow) {
    EXPECT_THAT(run().warnings, testing::Not(testing::Contains(testing::HasSubstr("material"))));
    writeFile(root_ / "scenes" / "t.gltf", triangleGltf("", R"(,"alphaMode":"BLEND")"));
    EXPECT_THAT(
        run().warnings,
        testing::Contains("scene \"triangle\": material \"m\" is translucent; it is drawn opaque"));
}

// What is drawn and what rays meet.
TEST_F(Generate, AGroundOccludesWhatStandsOnIt) {
    const auto grounded = [](const std::string& ground) {
        std::string text = tracedText();
        text.replace(text.find("radius = 0.3"), 0, "ground = { " + ground + " }\n");
        return text;
    };
    const std::string near = grounded("wall = -0.1");
    const GenerateResult result = run(near);
    for (const ImageRecord& image : result.manifest.conditions[0].images)
        EXPECT_GT(image.meanOcclusion, 0.03) << image.name;
    EXPECT_THAT(result.warnings,
                testing::Not(testing::Contains(testing::HasSubstr("next to nothing occludes"))));
    EXPECT_EQ(verified(near), 0);
    EXPECT_EQ(run(grounded("wall = -0.1, colour = [0.5, 0.5, 0.4]")).kept, 0);
    EXPECT_THAT(test::errorOf([&] { run(grounded("wall = 0.1")); }),
                testing::AllOf(testing::StartsWith("tiny.toml:4:1: scenes.triangle: ground.wall"),
                               testing::HasSubstr("begins at z = 0, found z = 0.1")));
}

// A triangle alone: nothing occludes it, and a technique that knows so is as open as none.
TEST_F(Generate, WarnsOfConditionsThatAreWorthNothing) {
    using testing::AllOf, testing::ElementsAre, testing::HasSubstr, testing::IsEmpty;
    const auto nothingOccludes =
        AllOf(HasSubstr("condition \"second\", view \"triangle\": next to nothing occludes"),
              HasSubstr("radius of 0.3 m; by rays the mean occlusion is 0.0000"));
    const auto alike =
        AllOf(HasSubstr("condition \"second\": images a (none) and b (few) look alike"),
              HasSubstr("1 of 255 at most and 0.05 on average, predicted JOD 10.00 of 10"));
    EXPECT_THAT(checked(protocolText()), ElementsAre(nothingOccludes, alike));
    EXPECT_THAT(run().warnings, ElementsAre(nothingOccludes, alike));
    EXPECT_THAT(run().warnings, IsEmpty()) << "of images that are kept";

    std::string text = protocolText(); // a threshold is looked for
    text.replace(text.find("id = \"second\""), 0, "correct = \"b\"\n");
    EXPECT_THAT(checked(text), ElementsAre(nothingOccludes));

    text = protocolText();
    text.replace(text.find("0.5, 1.5]"), 9, "0.5, 15]");
    EXPECT_THAT(checked(text),
                testing::Contains(HasSubstr("view \"triangle\": the view is all but empty; 0.")));

    makeCorner();
    text = protocolText();
    text.replace(text.rfind("level = \"high\""), 14, "level = \"low\"");
    EXPECT_THAT(checked(text), IsEmpty());
}

TEST_F(Generate, AMissingSceneNamesItsFile) {
    std::string text = protocolText();
    text.replace(text.find("t.gltf"), 6, "x.gltf");
    EXPECT_THAT(test::errorOf([&] { run(text); }),
                testing::AllOf(testing::StartsWith("tiny.toml:4:1: scenes.triangle: "),
                               testing::HasSubstr("x.gltf")));
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
