#pragma once

#include "renderer/ao.h"
#include "renderer/gl/context.h"
#include "renderer/image.h"
#include "renderer/settings.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

namespace obscura {

// One headless context for all tests of a program; a test that asks for nothing special shares it.
class GlTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        if (!context)
            context = std::make_unique<gl::Context>();
    }
    void TearDown() override { EXPECT_NO_THROW(gl::throwMessages()); }

    inline static std::unique_ptr<gl::Context> context;
};

// Adds a quad of one material, counter-clockwise corners seen from its front.
inline void addQuad(Scene& scene, std::array<glm::vec3, 4> corners) {
    if (scene.materials.empty()) {
        scene.materials.push_back({});
        scene.meshes.push_back({});
    }
    const glm::vec3 normal =
        glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const glm::vec3& corner : corners)
        scene.vertices.push_back({corner, normal, {}, {}});
    for (const std::uint32_t i : {0, 1, 2, 0, 2, 3})
        scene.indices.push_back(first + i);
    scene.meshes[0].indexCount = static_cast<std::uint32_t>(scene.indices.size());
}

// Visibility as a technique's passes leave it: 1 channel, top row first.
inline Image visibilityOf(const Scene& scene, const Camera& camera, const Settings& settings,
                          int width, int height, std::uint64_t seed = 1) {
    const GpuScene gpuScene(scene);
    const Frame frame = makeFrame(camera, width, height, gpuScene.bounds(), seed);
    const gl::UniformBuffer block = frameBuffer(frame);
    bindFrame(block);
    const GBuffer gbuffer(width, height, settings.technique().normals);
    GBufferPass().draw(gpuScene, frame, gbuffer);
    const OcclusionPasses passes(settings, width, height);
    const gl::Texture& texture = passes.visibility(gbuffer);
    Image image{width, height, 1, {}};
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (settings.technique().passes.empty()) {
        image.pixels.assign(count, 1.0f);
        return image;
    }
    const std::vector<float> values = gl::readFloats(texture, width, height, gl::Format::r16f);
    for (int y = height - 1; y >= 0; --y)
        image.pixels.insert(image.pixels.end(), values.begin() + y * width,
                            values.begin() + (y + 1) * width);
    return image;
}

} // namespace obscura
