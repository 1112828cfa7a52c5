// What a glTF file from outside may hold: every number in it may lie.
#include "base/error.h"
#include "base/files.h"
#include "renderer/scene/scene.h"
#include "tests/error_of.h"
#include "tests/folder.h"
#include "tests/renderer/scene/small_gltf.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>

namespace obscura {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

const fs::path cases = fs::path(OBSCURA_SOURCE) / ".." / "shared" / "cases" / "gltf";

// A small file that uses every kind of object that we read.
json fullGltf() {
    json root =
        json::parse(triangleGltf(R"(,"translation":[1,0,0],"rotation":[0,0,0,1],"scale":[1,1,1])",
                                 R"(,"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},)"
                                 R"("normalTexture":{"index":0,"scale":1},"alphaMode":"MASK",)"
                                 R"("alphaCutoff":0.5,"doubleSided":true)"));
    root["textures"] = json::parse(R"([{"source":0,"sampler":0}])");
    root["samplers"] =
        json::parse(R"([{"wrapS":33648,"wrapT":33071,"magFilter":9728,"minFilter":9987}])");
    root["images"] = json::parse(
        R"([{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="}])");
    root["scenes"][0]["name"] = "s";
    return root;
}

// The same with every extension of materials that we read.
json extendedGltf() {
    json root = fullGltf();
    json& material = root["materials"][0];
    material["normalTexture"]["extensions"] = json::parse(
        R"({"KHR_texture_transform":{"offset":[0,1],"rotation":1,"scale":[2,2],"texCoord":1}})");
    material["emissiveFactor"] = {1, 1, 1};
    material["extensions"] = json::parse(
        R"({"KHR_materials_emissive_strength":{"emissiveStrength":2},
            "KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[1,1,1,1],
              "specularFactor":[1,1,1],"glossinessFactor":1,"diffuseTexture":{"index":0}}})");
    root["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 0;
    return root;
}

class Gltf : public testing::Test {
  protected:
    Gltf() { writeFile(folder_ / "t.bin", triangleBuffer()); }

    fs::path write(const json& root, const std::string& name = "t.gltf") {
        put(name, root.dump());
        return folder_ / name;
    }
    // Thousands of files: without waiting for the disk, as writeFile() does.
    void put(const std::string& name, const std::string& content) {
        std::ofstream(folder_ / name, std::ios::binary) << content;
    }
    std::string errorOf(const json& root) {
        return test::errorOf([&] { loadScene(write(root)); });
    }

    test::Folder folder_;
};

TEST_F(Gltf, TheFullFileIsWell) {
    const Scene scene = loadScene(write(fullGltf()));
    ASSERT_EQ(scene.textures.size(), 2u); // as colour and as data
    EXPECT_EQ(scene.textures[0].wrapU, Wrap::mirrored);
    EXPECT_EQ(scene.textures[0].wrapV, Wrap::clamp);
    EXPECT_TRUE(scene.textures[0].nearest);
}

// Every place in the JSON, by its path.
void visit(json& value, const std::function<void(json&)>& change) {
    change(value);
    if (value.is_structured())
        for (auto& item : value)
            visit(item, change);
}

// Each value in turn becomes each of these; what is loaded then is a scene or an Error, and nothing
// else: no other exception, no crash (the sanitizers look too), no endless loop, no memory of
// gigabytes.
TEST_F(Gltf, EveryLieIsAnErrorOrHarmless) {
    const json lies = json::parse(R"([-1, 0, 1, 2, 3, 7, 99, 255, 65535, 2147483647, 2147483648,
        4294967295, 4611686018427387904, 18446744073709551615, -9223372036854775808, 0.5, -0.5, 1e15,
        1e30, 1e300, 1e-300, true, null, "", "x", "../t.bin", "/dev/zero", "t.gltf", "data:,",
        "data:;base64,////", "MAT4", "VEC2", "SCALAR", [], {}, [1e300, 1e300, 1e300], [0], [[[]]], 5120,
        5125, 5126, 4, 5, 6])");
    const json original = extendedGltf();
    json walked = original;
    std::size_t places = 0;
    visit(walked, [&](json&) { ++places; });
    std::size_t errors = 0, scenes = 0;
    for (std::size_t target = 0; target < places; ++target)
        for (const json& lie : lies) {
            json root = original;
            std::size_t at = 0;
            json* found = nullptr;
            visit(root, [&](json& value) {
                if (at++ == target)
                    found = &value;
            });
            *found = lie;
            try {
                loadScene(write(root));
                ++scenes;
            } catch (const Error& error) {
                ++errors;
                EXPECT_THAT(error.what(), HasSubstr("t.gltf")) << root.dump();
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            } catch (const std::exception& error) {
                ADD_FAILURE() << error.what() << " of " << root.dump();
            }
        }
    EXPECT_GT(errors, scenes);
    EXPECT_GT(scenes, 100u);
}

TEST_F(Gltf, EveryKeyMayBeMissing) {
    const json original = fullGltf();
    const std::function<void(const json::json_pointer&)> without =
        [&](const json::json_pointer& at) {
            const json& value = original.at(at);
            if (!value.is_structured())
                return;
            for (const auto& [key, item] : value.items()) {
                json root = original;
                if (value.is_object())
                    root.at(at).erase(key);
                else
                    root.at(at).erase(std::stoul(key));
                try {
                    loadScene(write(root));
                } catch (const Error&) {
                } catch (const std::exception& error) {
                    ADD_FAILURE() << error.what() << " without " << (at / key).to_string();
                }
                without(value.is_object() ? at / key : at / std::stoul(key));
            }
        };
    without(json::json_pointer());
}

std::string binaryOf(const json& root, const std::string& bin) {
    std::string text = root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) {
        std::string bytes(4, '\0');
        for (std::size_t i = 0; i < 4; ++i)
            bytes[i] = static_cast<char>(value >> 8 * i & 0xff);
        return bytes;
    };
    const std::string body =
        word(text.size()) + "JSON" + text + word(bin.size()) + std::string("BIN\0", 4) + bin;
    return "glTF" + word(2) + word(12 + body.size()) + body;
}

TEST_F(Gltf, ABinaryFileMayBeCutOrAlteredAnywhere) {
    json root = fullGltf();
    root["buffers"][0].erase("uri");
    const std::string whole = binaryOf(root, triangleBuffer());
    const auto load = [&](const std::string& content) {
        put("t.glb", content);
        try {
            loadScene(folder_ / "t.glb");
        } catch (const Error&) {
            return false;
        }
        return true;
    };
    EXPECT_TRUE(load(whole));
    for (std::size_t length = 0; length < whole.size(); length += length < 40 ? 1 : 37)
        EXPECT_FALSE(load(whole.substr(0, length))) << length;
    for (std::size_t at = 0; at < whole.size(); at += at < 24 ? 1 : 11)
        for (const char byte : {'\0', '\xff', '\x80', '9', '"'}) {
            std::string altered = whole;
            altered[at] = byte;
            load(altered); // throws nothing but Error
        }
}

TEST_F(Gltf, SaysWhereAndWhat) {
    json root = fullGltf();
    root["meshes"][0]["primitives"][0]["material"] = 4;
    EXPECT_THAT(errorOf(root), HasSubstr("meshes[0].primitives[0].material: expected an index into "
                                         "materials, 0 to 0, found 4"));
    root = fullGltf();
    root["accessors"][0]["byteOffset"] = 4294967292;
    EXPECT_THAT(errorOf(root), HasSubstr("accessors[0].byteOffset: expected a whole number"));
    root = fullGltf();
    root["accessors"][0]["count"] = 150000000;
    EXPECT_THAT(errorOf(root), AllOf(HasSubstr("accessors[0].count"), HasSubstr("150000000")));
    root = fullGltf();
    root["extensionsRequired"] = {"KHR_texture_basisu"};
    EXPECT_THAT(errorOf(root), HasSubstr("KTX2 cannot be read: export PNG, JPEG or WebP"));
}

TEST_F(Gltf, OpensNothingOutsideItsFolder) {
    const fs::path outside = folder_ / "outside.bin";
    writeFile(outside, triangleBuffer());
    fs::create_directories(folder_ / "scene");
    const auto errorOfUri = [&](const std::string& uri) {
        json root = fullGltf();
        root["buffers"][0]["uri"] = uri;
        return test::errorOf([&] { loadScene(write(root, "scene/t.gltf")); });
    };
    for (const std::string& uri :
         {std::string("../outside.bin"), std::string("%2e%2e/outside.bin"), outside.string(),
          std::string("a/../../outside.bin"), std::string("file:///etc/passwd"),
          std::string("https://example.com/a.bin"), std::string(""), std::string("/dev/zero")})
        EXPECT_THAT(errorOfUri(uri),
                    HasSubstr("buffers[0].uri: expected a file in the scene's folder"))
            << uri;
    fs::create_symlink("../outside.bin", folder_ / "scene" / "link.bin");
    EXPECT_THAT(errorOfUri("link.bin"), HasSubstr("expected a file in the scene's folder"));
    ASSERT_EQ(mkfifo((folder_ / "scene" / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(errorOfUri("pipe"), HasSubstr("expected a regular file"));
    EXPECT_THAT(errorOfUri("."), HasSubstr("expected a regular file"));
    EXPECT_THAT(errorOfUri("data:text/plain,hello"), HasSubstr("expected data:TYPE;base64"));
    const std::string longUri = "data:application/octet-stream;base64," + std::string(100000, '!');
    EXPECT_LT(errorOfUri(longUri).size(), 400u); // and does not print itself
}

TEST_F(Gltf, NamesWithBlanksAndPercentSignsAreFound) {
    writeFile(folder_ / "my file.bin", triangleBuffer());
    json root = fullGltf();
    root["buffers"][0]["uri"] = "my%20file.bin";
    EXPECT_NO_THROW(loadScene(write(root)));
    root["buffers"][0]["uri"] = "./my file.bin";
    EXPECT_NO_THROW(loadScene(write(root)));
}

TEST_F(Gltf, RefusesPositionsThatAreNoPlaces) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30F}) {
        std::string bytes = triangleBuffer();
        std::memcpy(bytes.data() + 4, &bad, sizeof bad);
        writeFile(folder_ / "t.bin", bytes);
        EXPECT_THAT(errorOf(fullGltf()),
                    HasSubstr("meshes[0].primitives[0].attributes.POSITION: expected finite"));
    }
}

TEST_F(Gltf, SharedNodesAreNoTree) {
    json root = fullGltf();
    for (int i = 0; i < 40; ++i) // each twice in the one before: 2^40 ways
        root["nodes"].push_back({{"children", {i + 2, i + 2}}});
    root["nodes"].push_back({{"mesh", 0}});
    root["scenes"][0]["nodes"] = {1};
    EXPECT_THAT(errorOf(root), HasSubstr("expected a tree of nodes"));
    root["nodes"][1]["children"] = {1};
    EXPECT_THAT(errorOf(root), HasSubstr("nodes[1]: expected a tree of nodes"));
}

TEST_F(Gltf, KeepsOnlyTheVerticesThatAreUsed) {
    json root = json::parse(trianglesGltf({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1}));
    writeFile(folder_ / "t.bin",
              trianglesBuffer({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1}));
    // Three of six vertices, as an index of bytes in the same buffer would have it.
    root["buffers"].push_back({{"uri", "data:;base64,AwQF"}, {"byteLength", 3}});
    root["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 3}});
    root["accessors"].push_back(
        {{"bufferView", 1}, {"componentType", 5121}, {"count", 3}, {"type", "SCALAR"}});
    for (int i = 0; i < 100; ++i) {
        json primitive = root["meshes"][0]["primitives"][0];
        primitive["indices"] = 1;
        root["meshes"][0]["primitives"].push_back(primitive);
    }
    EXPECT_EQ(loadScene(write(root)).vertices.size(), 6u + 100 * 3);
}

TEST_F(Gltf, StripsAndFansAreTriangles) {
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    json root = json::parse(trianglesGltf(corners));
    writeFile(folder_ / "t.bin", trianglesBuffer(corners));
    root["meshes"][0]["primitives"][0]["mode"] = 5;
    const Scene strip = loadScene(write(root));
    ASSERT_EQ(strip.indices.size(), 6u);
    for (const Vertex& vertex : strip.vertices)
        EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1)); // both turn the same way
    root["meshes"][0]["primitives"][0]["mode"] = 6;
    EXPECT_EQ(loadScene(write(root)).indices.size(), 6u);
    root["meshes"][0]["primitives"][0]["mode"] = 1;
    EXPECT_THAT(errorOf(root), HasSubstr("expected triangles, found none"));
}

TEST_F(Gltf, ASparseAccessorReplacesItsElements) {
    json root = fullGltf();
    // Vertex 2 becomes (0, 5, 0).
    root["buffers"].push_back(
        {{"uri", "data:;base64,AgAAAAAAAAAAAKBAAAAAAA=="}, {"byteLength", 16}});
    root["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 1}});
    root["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 4}, {"byteLength", 12}});
    root["accessors"][0]["sparse"] = json::parse(
        R"({"count":1,"indices":{"bufferView":3,"componentType":5121},"values":{"bufferView":4}})");
    EXPECT_EQ(loadScene(write(root)).vertices[2].position, glm::vec3(1, 5, 0));
    root["accessors"][0]["sparse"]["count"] = 2;
    EXPECT_THAT(errorOf(root), HasSubstr("accessors[0].sparse.indices.count"));
}

TEST_F(Gltf, ANormalMapWithoutDirectionIsNamedAndLeftOut) {
    json root = fullGltf();
    root["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    const Scene scene = loadScene(write(root));
    for (const Vertex& vertex : scene.vertices)
        EXPECT_EQ(vertex.tangent, glm::vec4(0));
    EXPECT_THAT(scene.warnings, testing::Contains(AllOf(HasSubstr("material \"m\""),
                                                        HasSubstr("at 3 of 3 vertices"))));
    EXPECT_EQ(loadScene(write(fullGltf())).warnings.size(), 0u);
}

TEST_F(Gltf, CoordinatesFarAwayAreTheSamePlaceOfARepeatedTexture) {
    std::string bytes = triangleBuffer();
    const float far[] = {5000.25F, 7001, 5001.25F, 7001, 5000.25F, 7000};
    std::memcpy(bytes.data() + 36, far, sizeof far);
    writeFile(folder_ / "t.bin", bytes);
    json root = fullGltf();
    root["samplers"][0] = json::object();
    for (const Vertex& vertex : loadScene(write(root)).vertices) {
        EXPECT_LT(std::abs(vertex.uv.x), 4);
        EXPECT_FLOAT_EQ(vertex.uv.x - std::floor(vertex.uv.x), 0.25F);
    }
    root["samplers"][0]["wrapS"] = 33071; // where it ends, it ends
    EXPECT_FLOAT_EQ(loadScene(write(root)).vertices[0].uv.x, 5000.25F);
}

TEST_F(Gltf, RefusesATextureLargerThanOpenGlTakes) {
    Image8 wide{16385, 1, 3, std::vector<std::uint8_t>(std::size_t{16385} * 3, 7)};
    writePng(folder_ / "wide.png", wide);
    json root = fullGltf();
    root["images"][0]["uri"] = "wide.png";
    EXPECT_THAT(errorOf(root), AllOf(HasSubstr("images[0]"), HasSubstr("wide.png"),
                                     HasSubstr("at most 16384 pixels"), HasSubstr("16385 x 1")));
}

// What extensions of materials say, as it is read.
TEST_F(Gltf, ReadsExtensionsOfMaterials) {
    json root = fullGltf();
    json& material = root["materials"][0];
    material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] =
        json::parse(R"({"offset":[0.5,0.25],"rotation":1.5,"scale":[2,3],"texCoord":4})");
    material["emissiveFactor"] = {0.5, 1, 0};
    material["emissiveTexture"] = {{"index", 0}, {"texCoord", 0}};
    material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 4;
    Scene scene = loadScene(write(root));
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
    Material read = scene.materials[0];
    EXPECT_EQ(read.baseColourTexture.offset, glm::vec2(0.5F, 0.25F));
    EXPECT_EQ(read.baseColourTexture.scale, glm::vec2(2, 3));
    EXPECT_EQ(read.baseColourTexture.rotation, 1.5F);
    EXPECT_EQ(read.baseColourTexture.set, 0); // that is TEXCOORD_4
    EXPECT_EQ(read.normalTexture.set, 1);
    EXPECT_EQ(read.emissionTexture.set, 1);
    EXPECT_EQ(read.emission, glm::vec3(2, 4, 0));
    for (const Vertex& vertex : scene.vertices)
        EXPECT_EQ(vertex.uv, glm::vec2(0)); // for the file has none of it
    EXPECT_EQ(scene.vertices[1].uv1, glm::vec2(1, 1));

    material["extensions"]["KHR_materials_pbrSpecularGlossiness"] = json::parse(
        R"({"diffuseFactor":[0.1,0.2,0.3,0.4],"specularFactor":[0.5,0.6,0.7],
            "glossinessFactor":0.8,"specularGlossinessTexture":{"index":0}})");
    read = loadScene(write(root)).materials[0];
    ASSERT_TRUE(read.specularGlossiness);
    EXPECT_EQ(read.baseColour, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_FALSE(read.baseColourTexture.exists());
    EXPECT_EQ(read.specularGlossiness->specular, glm::vec3(0.5F, 0.6F, 0.7F));
    EXPECT_EQ(read.specularGlossiness->glossiness, 0.8F);
    EXPECT_TRUE(read.metallicRoughnessTexture.exists());

    material["extensions"]["KHR_materials_unlit"] = json::object();
    read = loadScene(write(root)).materials[0];
    EXPECT_TRUE(read.unlit);
    EXPECT_FALSE(read.specularGlossiness);
    EXPECT_EQ(read.emission, glm::vec3(0));
    EXPECT_TRUE(read.baseColourTexture.exists());
}

TEST_F(Gltf, ReadsWebpAndPrefersItToTheFallback) {
    json root = fullGltf();
    // A red pixel, by libwebp 1.2.4.
    root["images"].push_back(
        {{"uri", "data:image/webp;base64,UklGRhwAAABXRUJQVlA4TA8AAAAvAAAAAAcQ/Y/+ByKi/wEA"}});
    root["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    Scene scene = loadScene(write(root));
    EXPECT_THAT(scene.textures[0].image.pixels, testing::ElementsAre(255, 0, 0, 255));
    root["textures"][0].erase("source");
    scene = loadScene(write(root));
    EXPECT_THAT(scene.textures[0].image.pixels, testing::ElementsAre(255, 0, 0, 255));
    root["textures"][0].erase("extensions");
    EXPECT_THAT(errorOf(root), HasSubstr("textures[0].source: expected an image, found none"));
}

TEST_F(Gltf, ReadsEverySampler) {
    json root = fullGltf();
    for (int filter = 0; filter < 6; ++filter) {
        root["samplers"][0]["minFilter"] = filter < 2 ? 9728 + filter : 9982 + filter;
        EXPECT_EQ(static_cast<int>(loadScene(write(root)).textures[0].minified), filter);
    }
    root["samplers"][0].erase("minFilter");
    EXPECT_EQ(loadScene(write(root)).textures[0].minified, Minified::linearMipmapLinear);
}

TEST_F(Gltf, RequiredQuantizationIsShown) {
    json root = fullGltf();
    root["extensionsRequired"] = {"KHR_mesh_quantization"};
    root["extensionsUsed"] = {"KHR_mesh_quantization"};
    EXPECT_THAT(loadScene(write(root)).warnings, testing::IsEmpty());
}

TEST_F(Gltf, AnExtensionThatIsNotDeclaredIsNamedToo) {
    json root = fullGltf();
    root["materials"][0]["extensions"]["KHR_materials_sheen"] = json::object();
    EXPECT_THAT(
        loadScene(write(root)).warnings,
        testing::ElementsAre(
            "extension KHR_materials_sheen is not supported; it is left out: cloth has no sheen"));
}

// The shared cases: b and c are refused, or named in a warning; f are scenes.
TEST_F(Gltf, SharedCasesBehave) {
    if (!fs::exists(cases))
        GTEST_SKIP() << "the shared cases are not beside the project (" << cases << ")";
    for (const fs::directory_entry& entry : fs::directory_iterator(cases)) {
        const std::string name = entry.path().filename().string();
        SCOPED_TRACE(name);
        try {
            const Scene scene = loadScene(entry.path());
            const bool odd = name[0] == 'b' || name[0] == 'c';
            // b37 has one scene and does not name it, which glTF allows.
            EXPECT_TRUE(!odd || !scene.warnings.empty() || name.starts_with("b37"));
        } catch (const Error& error) {
            EXPECT_TRUE(name[0] == 'b' || name[0] == 'c' || name.starts_with("f93"))
                << error.what();
        }
    }
}

} // namespace
} // namespace obscura
