// What glTF files say of vertices, poses, lights and cameras arrives in the scene as the
// specification has it: small files whose answers are known by hand.
#include "base/files.h"
#include "renderer/scene/scene.h"
#include "tests/error_of.h"
#include "tests/folder.h"
#include "tests/renderer/scene/packed_gltf.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace obscura {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const float half = std::sqrt(0.5F);

class GltfValues : public testing::Test {
  protected:
    // One triangle in the plane z = 0 whose normals look along +z.
    GltfValues() {
        auto& attributes = gltf_.primitive()["attributes"];
        attributes["POSITION"] = gltf_.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
        attributes["NORMAL"] = gltf_.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    }
    void set(const std::string& attribute, std::size_t accessor) {
        gltf_.primitive()["attributes"][attribute] = accessor;
    }
    Scene load() {
        writeFile(folder_ / "t.gltf", gltf_.json());
        writeFile(folder_ / "t.bin", gltf_.bytes);
        return loadScene(folder_ / "t.gltf");
    }
    std::string error() {
        return test::errorOf([&] { load(); });
    }

    test::Folder folder_;
    GltfBuilder gltf_;
};

void expectNear(const glm::vec3& found, const glm::vec3& expected) {
    EXPECT_LT(glm::distance(found, expected), 1e-6F) << found.x << " " << found.y << " " << found.z;
}

TEST_F(GltfValues, ColoursComeInThreeOrFourOfEveryKind) {
    const auto expect = [&](std::size_t accessor, const glm::vec4& colour, float within) {
        set("COLOR_0", accessor);
        const Scene scene = load();
        EXPECT_THAT(scene.warnings, testing::IsEmpty());
        EXPECT_LT(glm::distance(scene.vertices[1].colour, colour), within);
        EXPECT_EQ(scene.vertices[0].colour, glm::vec4(1));
    };
    using Bytes = std::vector<std::uint8_t>;
    using Shorts = std::vector<std::uint16_t>;
    expect(gltf_.floats({1, 1, 1, 0.25F, 0.5F, 0.75F, 0, 0, 0}, 3), {0.25, 0.5, 0.75, 1}, 1e-6F);
    expect(gltf_.floats({1, 1, 1, 1, 0.25F, 0.5F, 0.75F, 0.5F, 0, 0, 0, 0}, 4),
           {0.25, 0.5, 0.75, 0.5}, 1e-6F);
    const std::size_t padded = gltf_.view(Bytes{255, 255, 255, 9, 64, 128, 191, 9, 0, 0, 0, 9});
    gltf_.root["bufferViews"][padded]["byteStride"] = 4;
    expect(gltf_.accessor(padded, 3, "VEC3", 5121, true), {0.25, 0.5, 0.75, 1}, 0.005F);
    expect(gltf_.accessor(Bytes{255, 255, 255, 255, 64, 128, 191, 51, 0, 0, 0, 0}, 4, 5121, true),
           {0.25, 0.5, 0.75, 0.2}, 0.005F);
    // Such as forget to say that they are shares mean nothing else.
    expect(gltf_.accessor(Bytes{255, 255, 255, 255, 64, 128, 191, 51, 0, 0, 0, 0}, 4, 5121),
           {0.25, 0.5, 0.75, 0.2}, 0.005F);
    expect(
        gltf_.accessor(Shorts{65535, 65535, 65535, 65535, 16384, 32768, 49151, 13107, 0, 0, 0, 0},
                       4, 5123, true),
        {0.25, 0.5, 0.75, 0.2}, 1e-4F);
    const std::size_t wide =
        gltf_.view(Shorts{65535, 65535, 65535, 9, 16384, 32768, 49151, 9, 0, 0, 0, 9});
    gltf_.root["bufferViews"][wide]["byteStride"] = 8;
    expect(gltf_.accessor(wide, 3, "VEC3", 5123, true), {0.25, 0.5, 0.75, 1}, 1e-4F);
}

TEST_F(GltfValues, AColourThatIsNoNumberIsWhiteAndTold) {
    const float none = std::numeric_limits<float>::quiet_NaN();
    set("COLOR_0", gltf_.floats({1, 1, 1, none, 0, 0, 0, 0, 0}, 3));
    const Scene scene = load();
    EXPECT_EQ(scene.vertices[1].colour, glm::vec4(1));
    EXPECT_THAT(scene.warnings,
                ElementsAre(HasSubstr("meshes[0].primitives[0]: 1 vertex colours are no finite")));
    set("COLOR_0", gltf_.floats({1, 1, 1, 1, 1, 1}, 2));
    EXPECT_THAT(error(), HasSubstr("attributes.COLOR_0: expected an accessor of 3 or 4 floats"));
}

// Two targets; the mesh's weights hold unless the node has its own.
TEST_F(GltfValues, MorphTargetsMovePositionsNormalsAndTangents) {
    set("TANGENT", gltf_.floats({1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}, 4));
    gltf_.primitive()["targets"] = {{{"POSITION", gltf_.floats({0, 0, 2, 0, 0, 4, 0, 0, 0}, 3)},
                                     {"NORMAL", gltf_.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, 3)}},
                                    {{"POSITION", gltf_.floats({8, 0, 0, 0, 0, 0, 0, 0, 0}, 3)},
                                     {"TANGENT", gltf_.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, 3)}}};
    expectNear(load().vertices[0].position, {0, 0, 0}); // without weights, nothing
    gltf_.root["meshes"][0]["weights"] = {0.5, 0.25};
    Scene scene = load();
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
    expectNear(scene.vertices[0].position, {2, 0, 1});
    expectNear(scene.vertices[1].position, {1, 0, 2});
    expectNear(scene.vertices[2].position, {0, 1, 0});
    expectNear(scene.vertices[0].normal, glm::normalize(glm::vec3(0, 0.5, 1)));
    expectNear(scene.vertices[0].tangent, glm::normalize(glm::vec3(1, 0.25, 0)));
    EXPECT_EQ(scene.vertices[0].tangent.w, -1);
    gltf_.root["nodes"][0]["weights"] = {1, 0};
    scene = load();
    expectNear(scene.vertices[1].position, {1, 0, 4});
    expectNear(scene.vertices[0].normal, {0, half, half});
    gltf_.root["nodes"][0]["weights"] = {1};
    EXPECT_THAT(error(), HasSubstr("nodes[0].weights: expected 2 numbers, found [1]"));
    gltf_.root["nodes"][0].erase("weights");
    gltf_.primitive()["targets"][0]["POSITION"] = gltf_.floats({0, 0, 2}, 3);
    EXPECT_THAT(error(), HasSubstr("meshes[0].primitives[0].targets[0].POSITION: expected the 3 "
                                   "elements of POSITION, found 1"));
}

// Without normals of its own, a morphed mesh is flat where it has been moved to.
TEST_F(GltfValues, AMorphedMeshWithoutNormalsIsFlatWhereItIs) {
    gltf_.primitive()["attributes"].erase("NORMAL");
    gltf_.primitive()["targets"].push_back(
        json{{"POSITION", gltf_.floats({0, 0, 0, 0, 0, 1, 0, 0, 0}, 3)}});
    gltf_.root["meshes"][0]["weights"] = {1};
    expectNear(load().vertices[0].normal, {-half, 0, half});
}

// Joint 0 moves by (10, 0, 0), joint 1 turns a quarter about z; the node's own place counts
// nothing. Five joints hold vertex 2: two sets.
TEST_F(GltfValues, SkinsStandInTheirRestPose) {
    set("JOINTS_0",
        gltf_.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, 4, 5121));
    set("WEIGHTS_0", gltf_.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0, 0, 0}, 4));
    set("JOINTS_1",
        gltf_.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, 4, 5121));
    set("WEIGHTS_1", gltf_.floats({0, 0, 0, 0, 0, 0, 0, 0, 0.5F, 0, 0, 0}, 4));
    std::vector<float> bind(32, 0); // of joint 0 the identity, of joint 1 a move by (0, 0, 3)
    for (std::size_t i = 0; i < 4; ++i)
        bind[5 * i] = bind[16 + 5 * i] = 1;
    bind[16 + 14] = 3;
    const std::size_t view = gltf_.view(bind);
    gltf_.root["skins"] = {
        {{"joints", {1, 2}}, {"inverseBindMatrices", gltf_.accessor(view, 2, "MAT4", 5126)}}};
    gltf_.root["nodes"] =
        json::parse(R"([{"mesh":0,"skin":0,"translation":[100,100,100]},{"translation":[10,0,0]},)"
                    R"({"rotation":[0,0,0.70710678,0.70710678]}])");
    gltf_.root["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = load();
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
    expectNear(scene.vertices[0].position, {10, 0, 0});
    expectNear(scene.vertices[1].position, {0, 1, 3});
    expectNear(scene.vertices[2].position, {4.5, 0.5, 1.5}); // half of (10,1,0), half of (-1,0,3)
    gltf_.primitive()["attributes"].erase("WEIGHTS_1");
    EXPECT_THAT(error(), HasSubstr("expected JOINTS_1 and WEIGHTS_1 of a skinned mesh"));
}

// Each is scaled, turned and moved within the node, which is moved itself.
TEST_F(GltfValues, InstancesStandWhereEachIs) {
    gltf_.root["nodes"][0]["translation"] = {0, 0, 5};
    auto& instancing = gltf_.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"];
    instancing["attributes"] = {
        {"TRANSLATION", gltf_.floats({0, 0, 0, 10, 0, 0}, 3)},
        {"ROTATION",
         gltf_.accessor(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 127, 127}, 4, 5120, true)},
        {"SCALE", gltf_.floats({1, 1, 1, 2, 3, 1}, 3)}};
    gltf_.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Scene scene = load();
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
    ASSERT_EQ(scene.vertices.size(), 6U);
    expectNear(scene.vertices[1].position, {1, 0, 5});
    expectNear(scene.vertices[4].position, {10, 2, 5}); // (1, 0, 0) doubled, a quarter about z
    expectNear(scene.vertices[5].position, {7, 0, 5});
    instancing["attributes"]["SCALE"] = gltf_.floats({1, 1, 1}, 3);
    EXPECT_THAT(error(), HasSubstr("nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.SCALE: "
                                   "expected at most 1000000 elements of 3, as many as the other "
                                   "attributes have, found 1 of 3"));
}

json withLight(int index, json node) {
    node["extensions"]["KHR_lights_punctual"]["light"] = index;
    return node;
}

// The first stands in a node that is moved; the second looks along -x, the third down.
TEST_F(GltfValues, LightsStandWhereTheirNodesDo) {
    gltf_.root["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(
        R"([{"type":"point","color":[1,0.5,0],"intensity":8,"range":3},{"type":"directional"},)"
        R"({"type":"spot","spot":{"innerConeAngle":0.5}}])");
    gltf_.root["nodes"].push_back({{"children", {2, 3, 4}}, {"translation", {1, 2, 3}}});
    gltf_.root["nodes"].push_back(withLight(0, {{"translation", {0, 1, 0}}}));
    gltf_.root["nodes"].push_back(
        withLight(1, {{"rotation", {0, half, 0, half}}, {"scale", {2, 2, 2}}}));
    gltf_.root["nodes"].push_back(withLight(2, {{"rotation", {-half, 0, 0, half}}}));
    gltf_.root["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load();
    ASSERT_EQ(scene.lights.size(), 3U);
    const PointLight &point = scene.lights[0], &sun = scene.lights[1], &spot = scene.lights[2];
    using Kind = PointLight::Kind;
    EXPECT_THAT((std::array{point.kind, sun.kind, spot.kind}),
                ElementsAre(Kind::point, Kind::directional, Kind::spot));
    expectNear(point.position, {1, 3, 3});
    expectNear(point.intensity, {8, 4, 0});
    EXPECT_EQ(point.range, 3);
    expectNear(sun.direction, {-1, 0, 0});
    expectNear(sun.intensity, {1, 1, 1});
    expectNear(spot.direction, {0, -1, 0});
    EXPECT_FLOAT_EQ(spot.innerCosine, std::cos(0.5F));
    EXPECT_FLOAT_EQ(spot.outerCosine, half);
}

TEST_F(GltfValues, ALightThatIsNotThereIsAnError) {
    gltf_.root["nodes"][0] = withLight(1, gltf_.root["nodes"][0]);
    const std::string where = "nodes[0].extensions.KHR_lights_punctual.light: expected an index "
                              "into extensions.KHR_lights_punctual.lights, ";
    EXPECT_THAT(error(), HasSubstr(where + "of which there are none"));
    gltf_.root["extensions"]["KHR_lights_punctual"]["lights"] =
        json::parse(R"([{"type":"point"}])");
    EXPECT_THAT(error(), HasSubstr(where + "0 to 0, found 1"));
}

TEST_F(GltfValues, CamerasStandWhereTheirNodesDo) {
    gltf_.root["cameras"] = json::parse(
        R"([{"type":"perspective","name":"eye","perspective":{"yfov":1.0,"znear":0.25}},)"
        R"({"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":0,"zfar":9}}])");
    gltf_.root["nodes"].push_back(
        {{"camera", 0}, {"name", "door"}, {"translation", {0.5, 0.5, 7}}});
    gltf_.root["nodes"].push_back(
        {{"camera", 0}, {"rotation", {0, half, 0, half}}, {"scale", {3, 3, 3}}}); // along -x
    gltf_.root["nodes"].push_back({{"camera", 1}});
    gltf_.root["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Scene scene = load();
    EXPECT_THAT(scene.warnings, ElementsAre("orthographic cameras are left out"));
    ASSERT_EQ(scene.cameras.size(), 2U);
    const auto& [name, camera] = scene.cameras[0];
    EXPECT_EQ(name, "door");
    EXPECT_THAT(camera.position, ElementsAre(0.5, 0.5, 7));
    EXPECT_THAT(camera.target, ElementsAre(0.5, 0.5, 0)); // as far as the scene's middle
    EXPECT_THAT(camera.up, ElementsAre(0, 1, 0));
    EXPECT_NEAR(camera.fovDegrees, 57.29578, 1e-4);
    EXPECT_EQ(camera.near, 0.25);
    EXPECT_EQ(scene.cameras[1].name, "eye");
    EXPECT_NEAR(scene.cameras[1].camera.target[0], -1, 1e-6); // the middle is behind it
    gltf_.root["cameras"][0]["perspective"].erase("yfov");
    EXPECT_THAT(error(), HasSubstr("cameras[0].perspective: expected \"yfov\", found none"));
}

TEST_F(GltfValues, AllThatIsRequiredAndNotShownIsNamedAtOnce) {
    gltf_.root["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_texture_basisu",
                                        "ACME_warp_drive"};
    EXPECT_THAT(error(),
                AllOf(HasSubstr("extensionsRequired: expected extensions that are supported, found "
                                "2 that are not: KHR_texture_basisu (without it, textures in KTX2 "
                                "cannot be read: export PNG, JPEG or WebP); ACME_warp_drive "
                                "(export without it)"),
                      testing::Not(HasSubstr("quantization"))));
}

} // namespace
} // namespace obscura
