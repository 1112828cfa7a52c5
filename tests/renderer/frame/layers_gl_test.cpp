// Depth peeling, layer by layer.
#include "tests/renderer/frame/frame_fixture.h"

#include <array>

namespace obscura {
namespace {

// A square of 2 m that faces the camera, at this z.
void addSquare(Scene& scene, float z, bool away = false) {
    std::array corners{glm::vec3(-1, -1, z), glm::vec3(1, -1, z), glm::vec3(1, 1, z),
                       glm::vec3(-1, 1, z)};
    if (away)
        std::swap(corners[1], corners[3]);
    addQuad(scene, corners);
}

class PeeledLayers : public GlTest {
  protected:
    // Depths of all layers at a place of the image, shares of its size from the lower left.
    static std::array<float, 3> depthsAt(const Scene& scene, float separation, glm::vec2 place) {
        constexpr int size = 16;
        const GpuScene gpuScene(scene);
        const Frame frame = makeFrame(towardsSquare(), size, size, gpuScene.bounds(), 1);
        const gl::UniformBuffer block = frameBuffer(frame);
        bindFrame(block);
        const GBufferPass pass;
        const GBuffer gbuffer(size, size, {});
        pass.draw(gpuScene, frame, gbuffer);
        const gl::Target second(size, size, std::array{gl::Format::r32f}, true, "second"),
            third(size, size, std::array{gl::Format::r32f}, true, "third");
        pass.peel(gpuScene, frame, gbuffer.depth(), separation, second);
        pass.peel(gpuScene, frame, second.colour(0), separation, third);
        std::array<float, 3> depths;
        const gl::Texture* layers[] = {&gbuffer.depth(), &second.colour(0), &third.colour(0)};
        for (std::size_t i = 0; i < 3; ++i) {
            const float depth = gl::readTexel(*layers[i], static_cast<int>(place.x * size),
                                              static_cast<int>(place.y * size))[0];
            depths[i] = depth == frame.depth.y ? 0 : depth;
        }
        gl::throwMessages();
        return depths;
    }
    static void expectDepths(const std::array<float, 3>& found,
                             const std::array<float, 3>& expected) {
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(found[i], expected[i], 1e-5f) << "layer " << i + 1;
    }
};

// The camera is 2 m before z = 0. Depth 0 stands for an empty pixel.
TEST_F(PeeledLayers, AreTheNextThingsAtLeastTheSeparationBehind) {
    Scene scene;
    for (const float z : {-1.5f, 0.0f, -0.5f, -0.58f, -0.63f})
        addSquare(scene, z);
    expectDepths(depthsAt(scene, 0.1f, {0.5f, 0.5f}), {2, 2.5f, 2.63f});
    expectDepths(depthsAt(scene, 0.05f, {0.5f, 0.5f}), {2, 2.5f, 2.58f});
    expectDepths(depthsAt(scene, 0.6f, {0.5f, 0.5f}), {2, 2.63f, 3.5f});
    expectDepths(depthsAt(scene, 1, {0.5f, 0.5f}), {2, 3.5f, 0});
}

// Backs are seen where the material is double-sided, as in the G-buffer.
TEST_F(PeeledLayers, HaveTheBacksThatPicturesShow) {
    Scene scene;
    addSquare(scene, 0);
    addSquare(scene, -0.5f, true);
    addSquare(scene, -1);
    expectDepths(depthsAt(scene, 0.1f, {0.5f, 0.5f}), {2, 3, 0});
    scene.materials[0].doubleSided = true;
    expectDepths(depthsAt(scene, 0.1f, {0.5f, 0.5f}), {2, 2.5f, 3});
}

// Of two masked squares the first has no right half, the second no upper half.
TEST_F(PeeledLayers, HaveTheHolesOfMaskedMaterials) {
    Scene scene;
    addSquare(scene, 0);
    addSquare(scene, -0.5f);
    for (std::size_t i = 0; i < 4; ++i) {
        scene.vertices[i].colour.a = scene.vertices[i].position.x < 0 ? 1 : 0;
        scene.vertices[4 + i].colour.a = scene.vertices[4 + i].position.y < 0 ? 1 : 0;
    }
    addSquare(scene, -1);
    scene.materials.push_back({});
    scene.materials[0].alphaCutoff = 0.5f;
    scene.meshes = {{0, 12, 0}, {12, 6, 1}};
    expectDepths(depthsAt(scene, 0.1f, {0.3f, 0.3f}), {2, 2.5f, 3});
    expectDepths(depthsAt(scene, 0.1f, {0.3f, 0.7f}), {2, 3, 0});
    expectDepths(depthsAt(scene, 0.1f, {0.7f, 0.3f}), {2.5f, 3, 0});
    expectDepths(depthsAt(scene, 0.1f, {0.7f, 0.7f}), {3, 0, 0});
}

} // namespace
} // namespace obscura
