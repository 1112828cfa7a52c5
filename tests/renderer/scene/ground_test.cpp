#include "renderer/scene/ground.h"
#include "renderer/scene/quads.h"
#include "tests/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace obscura {
namespace {

using testing::HasSubstr;

Scene box() {
    Scene scene;
    addBox(scene, {0, 2, -1}, {1, 3, 2});
    scene.sha256 = "box";
    return scene;
}

TEST(Ground, LiesUnderAndBehindTheScene) {
    Scene scene = box();
    const std::size_t before = scene.indices.size();
    addGround(scene, {-1.5, {0.1, 0.2, 0.3}});
    const Bounds bounds = scene.bounds(); // the longest side is 3
    EXPECT_EQ(bounds.low, glm::vec3(0.5f - 6, 2, -1.5f));
    EXPECT_EQ(bounds.high, glm::vec3(0.5f + 6, 2 + 6, 2 + 6));
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[1].firstIndex, before);
    EXPECT_EQ(scene.meshes[1].indexCount, 12u);
    EXPECT_EQ(scene.materials[1].baseColour, glm::vec4(0.1f, 0.2f, 0.3f, 1));
    for (std::size_t i = before; i < scene.indices.size(); i += 3) { // up, then towards +z
        const glm::vec3 a = scene.vertices[scene.indices[i]].position,
                        b = scene.vertices[scene.indices[i + 1]].position,
                        c = scene.vertices[scene.indices[i + 2]].position,
                        facing = i < before + 6 ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
        EXPECT_EQ(glm::normalize(glm::cross(b - a, c - a)), facing);
        EXPECT_EQ(scene.vertices[scene.indices[i]].normal, facing);
    }
}

TEST(Ground, IsPartOfTheScenesHash) {
    Scene one = box(), lower = box(), darker = box();
    addGround(one, {-1.5, {0.5, 0.5, 0.5}});
    addGround(lower, {-1.6, {0.5, 0.5, 0.5}});
    addGround(darker, {-1.5, {0.5, 0.5, 0.4}});
    EXPECT_EQ(one.sha256, sha256With({-1.5, {0.5, 0.5, 0.5}}, "box"));
    EXPECT_NE(one.sha256, lower.sha256);
    EXPECT_NE(one.sha256, darker.sha256);
    EXPECT_NE(one.sha256, sha256With({-1.5, {0.5, 0.5, 0.5}}, "other"));
}

TEST(Ground, DoesNotCutTheScene) {
    Scene scene = box();
    EXPECT_THAT(test::errorOf([&] {
                    addGround(scene, {-0.9, {}});
                }),
                HasSubstr("which begins at z = -1, found z = -0.9"));
}

} // namespace
} // namespace obscura
