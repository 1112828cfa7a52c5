// What the depth buffer's truth takes for hidden: a panel that hovers before a wall.
#include "matching/truths.h"
#include "tests/renderer/techniques/occlusion_fixture.h"

#include <algorithm>
#include <filesystem>

namespace obscura {
namespace {

namespace fs = std::filesystem;

constexpr int size = 48;
constexpr float radius = 0.4f;

class Truths : public GlTest {
  protected:
    void SetUp() override {
        cache_ = fs::path(testing::TempDir()) /
                 (std::string("obscura_truths_") +
                  testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(cache_);
    }
    void TearDown() override {
        fs::remove_all(cache_);
        GlTest::TearDown();
    }

    // The least visibility on the wall, with the panel `gap` before it. The camera is 50 m away, so
    // that the panel hides next to nothing of the wall but what is behind it.
    double darkest(float gap) const {
        Scene scene;
        const auto square = [&](float half, float z) {
            addQuad(scene, {glm::vec3(-half, -half, z), glm::vec3(half, -half, z),
                            glm::vec3(half, half, z), glm::vec3(-half, half, z)});
        };
        square(4, 0);
        square(0.4f, gap);
        View view;
        view.radius = static_cast<double>(radius);
        view.camera.position = {0, 0, 50};
        view.camera.fovDegrees = 2;
        const Subject subject(scene);
        const Probe probe(subject, view.camera, size, size, Normals::smooth, 1);
        LazyTracer tracer(scene);
        const Image image = truthOf(Truth::depth, {view, {size, size}, 128, Normals::smooth, 1},
                                    probe, tracer, std::to_string(gap), cache_);
        return static_cast<double>(*std::min_element(image.pixels.begin(), image.pixels.end()));
    }

    fs::path cache_;
};

// A ray that is as long as the radius cannot get from the wall to the panel, nor to what is less
// than a radius behind it; a solid from the panel's face to the wall would block half of them.
TEST_F(Truths, WhatIsFartherThanTheRadiusInFrontDoesNotBlock) {
    EXPECT_EQ(darkest(2.5f * radius), 1);
    EXPECT_LT(darkest(0.5f * radius), 0.8);
}

// A truth of another thickness must not be taken from the cache of an earlier program.
TEST_F(Truths, TheCacheNamesTheThickness) {
    darkest(radius);
    const auto name = fs::directory_iterator(cache_)->path().filename().string();
    EXPECT_TRUE(name.ends_with("-depth-0x1.99999ap-2.exr")) << name; // 0.4f
}

} // namespace
} // namespace obscura
