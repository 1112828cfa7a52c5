#include "base/error.h"
#include "renderer/builtin/builtin.h"
#include "renderer/framing.h"
#include "renderer/reference/ray_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace obscura {
namespace {

using testing::AllOf;
using testing::Ge;
using testing::HasSubstr;
using testing::Le;
using testing::Lt;

// Each scene is made once for all tests.
const Scene& sceneNamed(const std::string& name) {
    static std::map<std::string, Scene> scenes;
    if (!scenes.contains(name))
        scenes[name] = builtinScene(name);
    return scenes[name];
}

class BuiltinScene : public testing::TestWithParam<std::string> {
  protected:
    const Scene& scene = sceneNamed(GetParam());

    const Vertex& corner(std::size_t i) const { return scene.vertices[scene.indices[i]]; }
    glm::vec3 doubleArea(std::size_t first) const {
        const glm::vec3 a = corner(first).position;
        return glm::cross(corner(first + 1).position - a, corner(first + 2).position - a);
    }
};

TEST_P(BuiltinScene, VerticesAreFiniteWithUnitNormals) {
    std::size_t wrong = 0;
    for (const Vertex& vertex : scene.vertices) {
        const bool finite = std::isfinite(glm::dot(vertex.position, vertex.position)) &&
                            std::isfinite(glm::dot(vertex.uv, vertex.uv)) &&
                            std::isfinite(glm::dot(vertex.tangent, vertex.tangent));
        const bool unit = std::abs(glm::length(vertex.normal) - 1) < 1e-4F;
        wrong += finite && unit ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(scene.vertices.size(), 10000U);
}

TEST_P(BuiltinScene, MeshesCoverAllIndices) {
    std::size_t next = 0;
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_EQ(mesh.firstIndex, next);
        EXPECT_GT(mesh.indexCount, 0U);
        EXPECT_EQ(mesh.indexCount % 3, 0U);
        EXPECT_THAT(mesh.material, AllOf(Ge(0), Lt(static_cast<int>(scene.materials.size()))));
        next += mesh.indexCount;
    }
    EXPECT_EQ(next, scene.indices.size());
    for (const std::uint32_t index : scene.indices)
        ASSERT_LT(index, scene.vertices.size());
}

TEST_P(BuiltinScene, TrianglesHaveAreaAndFaceTheirNormals) {
    std::size_t flat = 0, backward = 0;
    for (std::size_t i = 0; i < scene.indices.size(); i += 3) {
        const glm::vec3 normals = corner(i).normal + corner(i + 1).normal + corner(i + 2).normal;
        flat += glm::length(doubleArea(i)) > 1e-9F ? 0 : 1;
        backward += glm::dot(doubleArea(i), normals) > 0 ? 0 : 1;
    }
    EXPECT_EQ(flat, 0U);
    EXPECT_EQ(backward, 0U);
}

TEST_P(BuiltinScene, NothingIsUnused) {
    std::vector<bool> used(scene.vertices.size());
    for (const std::uint32_t index : scene.indices)
        used[index] = true;
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
    std::vector<bool> shown(scene.textures.size());
    for (const Material& material : scene.materials)
        for (const TextureUse& use : {material.baseColourTexture, material.normalTexture,
                                      material.metallicRoughnessTexture})
            if (use.exists())
                shown.at(static_cast<std::size_t>(use.texture)) = true;
    EXPECT_EQ(std::count(shown.begin(), shown.end(), false), 0);
}

TEST_P(BuiltinScene, TexturesAreWhole) {
    for (const Texture& texture : scene.textures) {
        EXPECT_EQ(texture.image.channels, 4);
        EXPECT_THAT(texture.image.width, AllOf(Ge(256), Le(1024)));
        EXPECT_EQ(texture.image.height, texture.image.width);
        EXPECT_EQ(texture.image.pixels.size(), 4 * static_cast<std::size_t>(texture.image.width) *
                                                   static_cast<std::size_t>(texture.image.height));
    }
}

TEST_P(BuiltinScene, MaterialsUseColourAsColourAndDataAsData) {
    for (const Material& material : scene.materials) {
        const auto srgb = [&](const TextureUse& use) {
            return use.exists() && scene.textures[static_cast<std::size_t>(use.texture)].srgb;
        };
        EXPECT_FALSE(material.name.empty());
        EXPECT_EQ(srgb(material.baseColourTexture), material.baseColourTexture.exists());
        EXPECT_FALSE(srgb(material.normalTexture));
        EXPECT_FALSE(srgb(material.metallicRoughnessTexture));
        EXPECT_THAT(material.roughness, AllOf(Ge(0.0F), Le(1.0F)));
    }
}

TEST_P(BuiltinScene, NormalMapsHaveTangents) {
    for (const Mesh& mesh : scene.meshes) {
        if (scene.materials[static_cast<std::size_t>(mesh.material)].normalTexture.texture < 0)
            continue;
        std::size_t wrong = 0;
        for (std::size_t i = mesh.firstIndex; i < mesh.firstIndex + mesh.indexCount; ++i) {
            const glm::vec4 tangent = corner(i).tangent;
            const float length = glm::length(glm::vec3(tangent));
            wrong += std::abs(length - 1) < 1e-4F && std::abs(tangent.w) == 1 ? 0 : 1;
        }
        EXPECT_EQ(wrong, 0U) << scene.materials[static_cast<std::size_t>(mesh.material)].name;
    }
}

TEST_P(BuiltinScene, IsTheSameEachTime) {
    const Scene again = builtinScene(GetParam());
    EXPECT_EQ(again.sha256, scene.sha256);
    EXPECT_EQ(again.sha256.size(), 64U);
    EXPECT_EQ(again.vertices.size(), scene.vertices.size());
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinScene,
                         testing::ValuesIn(std::vector<std::string>(builtinSceneNames().begin(),
                                                                    builtinSceneNames().end())),
                         [](const auto& scene) { return scene.param; });

TEST(BuiltinSizes, SculptureStandsOnTheGroundAboutAMetreTall) {
    const Bounds bounds = sceneNamed("sculpture").bounds();
    EXPECT_NEAR(bounds.low.y, 0, 0.005);
    EXPECT_NEAR(bounds.high.y, 1.2, 0.05);
    EXPECT_NEAR(bounds.high.x - bounds.low.x, 0.8, 0.05);
}

TEST(BuiltinSizes, AtriumIsAboutAsLargeAsSponza) {
    const Bounds bounds = sceneNamed("atrium").bounds();
    EXPECT_NEAR(bounds.high.x - bounds.low.x, 25, 1);
    EXPECT_NEAR(bounds.high.z - bounds.low.z, 15.7, 1);
    EXPECT_NEAR(bounds.high.y, 9, 0.3);
}

TEST(BuiltinSizes, AtriumHasCutOutLeavesAndThinCloth) {
    const Scene& scene = sceneNamed("atrium");
    int cutOut = 0, thin = 0;
    for (const Material& material : scene.materials) {
        cutOut += material.alphaCutoff > 0 ? 1 : 0;
        thin += material.doubleSided ? 1 : 0;
    }
    EXPECT_GE(cutOut, 1);
    EXPECT_GE(thin, 2);
}

// What the scene is for: the base colour alone already shows the creases.
TEST(BuiltinSizes, FiguresHaveOcclusionPaintedIntoTheirColours) {
    const Scene& scene = sceneNamed("figures");
    for (const char* name : {"reader", "guard"}) {
        const auto material =
            std::find_if(scene.materials.begin(), scene.materials.end(),
                         [&](const Material& candidate) { return candidate.name == name; });
        ASSERT_NE(material, scene.materials.end());
        const Image8& image =
            scene.textures[static_cast<std::size_t>(material->baseColourTexture.texture)].image;
        std::size_t dark = 0;
        for (std::size_t i = 0; i < image.pixels.size(); i += 4)
            dark += image.pixels[i] < 60 ? 1 : 0;
        EXPECT_GT(dark, image.pixels.size() / 4 / 20) << name;
    }
}

std::size_t trianglesOf(const Scene& scene) { return scene.indices.size() / 3; }

TEST(BuiltinSizes, RoomIsAsLargeAsARoomAndLightEnough) {
    const Bounds bounds = sceneNamed("room").bounds();
    EXPECT_NEAR(bounds.high.y, 2.8, 0.05); // the ceiling's upper side
    EXPECT_NEAR(bounds.high.z - bounds.low.z, 5.2, 0.05);
    EXPECT_NEAR(bounds.low.x, -3.3, 0.05);
    EXPECT_LT(trianglesOf(sceneNamed("room")), 150000U);
}

TEST(BuiltinSizes, GardenIsAsLargeAsAGardenAndLightEnough) {
    const Bounds bounds = sceneNamed("garden").bounds();
    EXPECT_NEAR(bounds.high.y, 5, 0.5);   // the tree
    EXPECT_NEAR(bounds.low.z, -4.5, 0.1); // the hedge beyond the lane
    EXPECT_LT(trianglesOf(sceneNamed("garden")), 250000U);
}

// No light leaks: what leaves the room's middle without meeting anything leaves by a window.
TEST(BuiltinRoom, IsOpenAtItsWindowsAlone) {
    const RayScene rays(sceneNamed("room"));
    const glm::vec3 eye(0.3F, 1.9F, 0.2F);
    int open = 0, elsewhere = 0;
    for (int i = 0; i < 60000; ++i) { // Fibonacci's points on the sphere
        const float y = 1 - (2 * static_cast<float>(i) + 1) / 60000;
        const float turn = 2.3999632F * static_cast<float>(i), out = std::sqrt(1 - y * y);
        const glm::vec3 way(out * std::cos(turn), y, out * std::sin(turn));
        RTCRayHit ray{};
        ray.ray = {eye.x, eye.y, eye.z, 0, way.x, way.y, way.z, 0, INFINITY, ~0U, 0, 0};
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        findNearest(rays.handle(), ray);
        if (!std::isinf(ray.ray.tfar))
            continue;
        ++open;
        const auto within = [&](int axis, float face, glm::vec2 along, glm::vec2 up) {
            const glm::vec3 p = eye + (face - eye[axis]) / way[axis] * way;
            return way[axis] * face > 0 && p[2 - axis] > along.x && p[2 - axis] < along.y &&
                   p.y > up.x && p.y < up.y;
        };
        elsewhere += within(0, 3, {-1.5F, 0.7F}, {0.32F, 2.28F}) ||
                             within(2, -2.3F, {0.35F, 1.75F}, {0.92F, 2.28F})
                         ? 0
                         : 1;
    }
    EXPECT_GT(open, 300);
    EXPECT_EQ(elsewhere, 0);
}

TEST(BuiltinRoom, IsFramedFromWithin) {
    const Scene& scene = sceneNamed("room");
    const Framing found = framing(scene, RayTracer(scene), 1);
    EXPECT_TRUE(found.inside) << found.why;
}

// Seen from outside it is the backs of walls and hedges: the garden brings its own camera.
TEST(BuiltinGarden, IsFramedFromItsTerrace) {
    const Scene& scene = sceneNamed("garden");
    const Framing found = framing(scene, RayTracer(scene), 1);
    EXPECT_NEAR(found.camera.position[0], 3.9, 1e-3) << found.why;
    EXPECT_NEAR(found.camera.position[2], 3.4, 1e-3) << found.why;
}

TEST(BuiltinGarden, HasCutOutLeavesAndThinBlades) {
    const Scene& scene = sceneNamed("garden");
    std::size_t cutOut = 0, blades = 0;
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
        cutOut += material.alphaCutoff > 0 ? mesh.indexCount / 3 : 0;
        blades += material.name == "grass" ? mesh.indexCount / 3 : 0;
    }
    EXPECT_GT(cutOut, 50000U);
    EXPECT_GT(blades, 50000U);
}

TEST(BuiltinNames, UnknownNameIsAnErrorThatGivesTheNearest) {
    try {
        builtinScene("atriun");
        FAIL() << "expected an Error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("no built-in scene \"atriun\""));
        EXPECT_THAT(error.what(), HasSubstr("atrium"));
    }
}

// Every member of a scene that decides a pixel decides its hash.
TEST(ContentHash, DiffersWithEverything) {
    Scene base;
    base.vertices.resize(3);
    base.indices = {0, 1, 2};
    base.meshes = {{0, 3, 0}};
    base.materials = {{.name = "clay"}};
    base.textures.resize(1);
    base.textures[0].image = {1, 1, 4, {1, 2, 3, 4}};
    std::set<std::string> hashes{contentSha256(base)};
    std::size_t changes = 1;
    const auto change = [&](const std::function<void(Scene&)>& by) {
        Scene changed = base;
        by(changed);
        hashes.insert(contentSha256(changed));
        EXPECT_EQ(hashes.size(), ++changes);
    };
    change([](Scene& s) { s.vertices[2].position.x += 1e-6F; });
    change([](Scene& s) { s.vertices[1].normal.y = 1; });
    change([](Scene& s) { s.vertices[1].tangent.w = -1; });
    change([](Scene& s) { s.vertices[0].uv.y = 1; });
    change([](Scene& s) { s.vertices[0].uv1.y = 1; });
    change([](Scene& s) { s.vertices[2].colour.a = 0.5F; });
    change([](Scene& s) { s.lights.resize(1); });
    change([](Scene& s) { s.lights.resize(2); });
    change([](Scene& s) { s.lights.push_back({.intensity = {1, 1, 2}}); });
    change([](Scene& s) { s.indices[2] = 1; });
    change([](Scene& s) { s.meshes[0].material = 1; });
    change([](Scene& s) { s.meshes[0].indexCount = 0; });
    change([](Scene& s) { s.meshes[0].firstIndex = 3; });
    change([](Scene& s) { s.materials[0].baseColour.b = 0.5F; });
    change([](Scene& s) { s.materials[0].baseColourTexture.texture = 0; });
    change([](Scene& s) { s.materials[0].normalTexture.texture = 0; });
    change([](Scene& s) { s.materials[0].normalScale = 2; });
    change([](Scene& s) { s.materials[0].metallicRoughnessTexture.texture = 0; });
    change([](Scene& s) { s.materials[0].baseColourTexture.set = 1; });
    change([](Scene& s) { s.materials[0].baseColourTexture.offset.y = 1; });
    change([](Scene& s) { s.materials[0].baseColourTexture.scale.x = 2; });
    change([](Scene& s) { s.materials[0].baseColourTexture.rotation = 1; });
    change([](Scene& s) { s.materials[0].emission.g = 1; });
    change([](Scene& s) { s.materials[0].unlit = true; });
    change([](Scene& s) { s.materials[0].specularGlossiness.emplace(); });
    change([](Scene& s) { s.materials[0].specularGlossiness = {{1, 1, 1}, 0.5F}; });
    change([](Scene& s) { s.materials[0].metallic = 1; });
    change([](Scene& s) { s.materials[0].roughness = 0; });
    change([](Scene& s) { s.materials[0].alphaCutoff = 0.5F; });
    change([](Scene& s) { s.materials[0].doubleSided = true; });
    change([](Scene& s) { s.textures[0].srgb = true; });
    change([](Scene& s) { s.textures[0].wrapU = Wrap::clamp; });
    change([](Scene& s) { s.textures[0].wrapV = Wrap::mirrored; });
    change([](Scene& s) { s.textures[0].nearest = true; });
    change([](Scene& s) { s.textures[0].minified = Minified::linear; });
    change([](Scene& s) { s.textures[0].image.pixels[0] = 9; });
    change([](Scene& s) { s.textures[0].image.width = 2; });
    base.materials[0].name = "mud"; // shows nowhere
    EXPECT_TRUE(hashes.contains(contentSha256(base)));
}

} // namespace
} // namespace obscura
