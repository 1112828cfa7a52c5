#include "base/error.h"
#include "base/files.h"
#include "renderer/scene/scene.h"
#include "tests/renderer/scene/small_gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace obscura {
namespace {

namespace fs = std::filesystem;

const fs::path shared = fs::path(OBSCURA_SOURCE) / ".." / "shared" / "scenes";

class SceneFile : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  (std::string("obscura_scene_") +
                   testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(folder_);
        writeFile(folder_ / "t.bin", triangleBuffer());
    }
    Scene load(const std::string& node = "", const std::string& material = "",
               const std::string& extra = "") {
        writeFile(folder_ / "t.gltf", triangleGltf(node, material, extra));
        return loadScene(folder_ / "t.gltf");
    }
    std::string errorOf(const std::string& node, const std::string& material = "",
                        const std::string& extra = "") {
        try {
            load(node, material, extra);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    fs::path folder_;
};

TEST_F(SceneFile, WithoutNormalsIsFlat) {
    const Scene scene = load();
    ASSERT_EQ(scene.vertices.size(), 3u);
    for (const Vertex& vertex : scene.vertices)
        EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1));
}

TEST_F(SceneFile, AppliesTranslationRotationAndScaleInGltfsOrder) {
    // Scale by 2, turn 90 degrees about z, move by (10, 0, 0).
    const Scene scene = load(R"(,"translation":[10,0,0],"rotation":[0,0,0.70710678,0.70710678],)"
                             R"("scale":[2,2,2])");
    EXPECT_NEAR(glm::distance(scene.vertices[1].position, glm::vec3(10, 2, 0)), 0, 1e-5f);
    EXPECT_NEAR(glm::distance(scene.vertices[2].position, glm::vec3(8, 0, 0)), 0, 1e-5f);
}

TEST_F(SceneFile, AMirroredNodeKeepsItsFrontInFront) {
    const Scene scene = load(R"(,"scale":[-1,1,1])");
    const glm::vec3 a = scene.vertices[scene.indices[0]].position,
                    b = scene.vertices[scene.indices[1]].position,
                    c = scene.vertices[scene.indices[2]].position;
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), scene.vertices[0].normal), 0);
    EXPECT_GT(scene.vertices[0].normal.z, 0);
}

TEST_F(SceneFile, ReadsMaskAndSides) {
    const Scene scene = load("", R"(,"alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true)");
    EXPECT_FLOAT_EQ(scene.materials[0].alphaCutoff, 0.25f);
    EXPECT_TRUE(scene.materials[0].doubleSided);
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
}

TEST_F(SceneFile, NamesWhatIsLeftOut) {
    const Scene scene = load("", R"(,"alphaMode":"BLEND","emissiveFactor":[1,0,0])",
                             R"(,"extensionsUsed":["KHR_materials_clearcoat"])");
    EXPECT_THAT(
        scene.warnings,
        testing::UnorderedElementsAre(
            "extension KHR_materials_clearcoat is not supported; it is left out: clear coats do "
            "not shine",
            "material \"m\" is translucent; it is drawn opaque"));
}

TEST_F(SceneFile, RefusesWhatItRequiresAndWeCannotShow) {
    EXPECT_THAT(
        errorOf("", "",
                R"(,"extensionsRequired":["KHR_texture_basisu"],)"
                R"("extensionsUsed":["KHR_texture_basisu"])"),
        testing::HasSubstr("t.gltf: extensionsRequired: expected extensions that are supported, "
                           "found 1 that is not: KHR_texture_basisu"));
}

TEST_F(SceneFile, RefusesMissingAndShortBuffersAndTextures) {
    const std::string textured = R"(,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}})";
    const std::string image = R"(,"textures":[{"source":0}],"images":[{"uri":"gone.png"}])";
    EXPECT_THAT(errorOf("", textured, image), testing::HasSubstr("gone.png"));
    writeFile(folder_ / "t.bin", triangleBuffer().substr(0, 40));
    EXPECT_NE(errorOf(""), "");
    fs::remove(folder_ / "t.bin");
    EXPECT_THAT(errorOf(""), testing::HasSubstr("t.bin"));
}

TEST_F(SceneFile, RefusesAnIndexPastTheVertices) {
    std::string bytes = triangleBuffer();
    bytes[60] = 9;
    writeFile(folder_ / "t.bin", bytes);
    EXPECT_THAT(errorOf(""), testing::HasSubstr("index 9 points past the 3 vertices"));
}

TEST_F(SceneFile, ItsHashCoversEveryFileItNames) {
    const std::string before = load().sha256;
    EXPECT_EQ(before, sceneSha256(folder_ / "t.gltf"));
    std::string bytes = triangleBuffer();
    bytes[0] = 1;
    writeFile(folder_ / "t.bin", bytes);
    EXPECT_NE(load().sha256, before);
}

TEST_F(SceneFile, AMissingFileSaysWhereScenesAreLookedFor) {
    try {
        loadScene(folder_ / "absent.gltf");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("--scenes or OBSCURA_SCENES"));
    }
}

// Scenes that nobody here modelled. Skipped, loudly, where the shared folder is absent.
class SharedScene : public testing::Test {
  protected:
    void SetUp() override {
        if (!fs::exists(shared))
            GTEST_SKIP() << "the shared scenes are not beside the project (" << shared << ")";
    }
};

TEST_F(SharedScene, SponzaHasItsTrianglesMaterialsAndBounds) {
    const Scene scene = loadScene(shared / "sponza" / "Sponza.gltf");
    EXPECT_EQ(scene.indices.size() / 3, 262267u);
    EXPECT_EQ(scene.meshes.size(), 103u);
    EXPECT_EQ(scene.materials.size(), 25u);
    EXPECT_EQ(std::count_if(scene.materials.begin(), scene.materials.end(),
                            [](const Material& m) { return m.alphaCutoff > 0; }),
              3);
    const Bounds bounds = scene.bounds();
    EXPECT_NEAR(bounds.low.x, -15.4f, 0.1f);
    EXPECT_NEAR(bounds.high.y, 11.4f, 0.1f);
    // Sixteen corners of it were exported without a tangent.
    EXPECT_THAT(scene.warnings,
                testing::ElementsAre(testing::AllOf(testing::HasSubstr("\"Material_5\""),
                                                    testing::HasSubstr("at 16 of 1074 vertices"))));
}

TEST_F(SharedScene, TheDragonIsABinaryFileOfOneUnit) {
    const Scene scene = loadScene(shared / "dragon" / "dragon.glb");
    EXPECT_EQ(scene.indices.size() / 3, 202520u);
    EXPECT_NEAR(scene.bounds().high.y, 1, 1e-3f);
}

// Tangents that another tool derived are the truth for direction and mirroring. Its sign is the
// opposite of ours all over: its bitangents point down the image, where glTF says that a normal
// map's green points up (rivets on the robot, painted lit from above, come out lit from below). We
// show a file's own tangents as they are, and derive missing ones as glTF says.
TEST_F(SharedScene, DerivedTangentsAgreeWithTheFiles) {
    for (const char* file : {"sponza/Sponza.gltf", "robot/robot.gltf"}) {
        Scene scene = loadScene(shared / file);
        const std::vector<Vertex> given = scene.vertices;
        for (const Mesh& mesh : scene.meshes)
            deriveTangents(scene, mesh);
        double agree = 0, opposite = 0;
        for (std::size_t i = 0; i < given.size(); ++i) {
            agree +=
                glm::dot(glm::vec3(given[i].tangent), glm::vec3(scene.vertices[i].tangent)) > 0.9f;
            opposite += given[i].tangent.w != scene.vertices[i].tangent.w;
        }
        EXPECT_GT(agree / static_cast<double>(given.size()), 0.99) << file;
        EXPECT_GT(opposite / static_cast<double>(given.size()), 0.99) << file;
    }
}

// The extension's own example: "the lower left quadrant of the source image".
TEST(TextureUse, AQuarterTurnIsThatOfTheExtensionsExample) {
    TextureUse use;
    EXPECT_TRUE(use.plain());
    use.offset = {0, 1};
    use.scale = {0.5f, 0.5f};
    use.rotation = 1.57079632679f;
    EXPECT_FALSE(use.plain());
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}) {
        Vertex vertex;
        vertex.uv = corner;
        const glm::vec2 at = use.at(vertex);
        EXPECT_NEAR(at.x, 0.5f * corner.y, 1e-6f);
        EXPECT_NEAR(at.y, 1 - 0.5f * corner.x, 1e-6f);
    }
    use.set = 1;
    EXPECT_NEAR(use.at({.uv = {1, 1}, .uv1 = {0, 1}}).x, 0.5f, 1e-6f);
}

} // namespace
} // namespace obscura
