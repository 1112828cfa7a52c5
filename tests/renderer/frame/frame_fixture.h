#pragma once

#include "image/image.h"
#include "renderer/frame/composite.h"
#include "renderer/scene/quads.h"
#include "tests/renderer/gl_test.h"

#include <filesystem>
#include <vector>

namespace obscura {

// What one small picture holds, rows from the bottom.
struct Drawn {
    int width = 0, height = 0;
    std::vector<glm::vec4> albedo, normal, emission; // the last may be empty
    std::vector<float> depth;
    std::vector<glm::vec4> ambient, direct; // the last may be empty
    std::vector<glm::vec4> displayed;       // where visibility is as asked for

    std::size_t middle() const { return static_cast<std::size_t>(height / 2 * width + width / 2); }
};

inline std::vector<glm::vec4> vectorsOf(const gl::Texture& texture, int width, int height) {
    const std::vector<float> values = gl::readFloats(texture, width, height, gl::Format::rgba32f);
    std::vector<glm::vec4> result;
    for (std::size_t i = 0; i < values.size(); i += 4)
        result.emplace_back(values[i], values[i + 1], values[i + 2], values[i + 3]);
    return result;
}

struct Picture {
    Camera camera;
    Level level;
    std::filesystem::path environment = {};
    float visibility = 1;
    int width = 32, height = 18;
};

inline Drawn draw(const Scene& scene, const Picture& picture) {
    const int width = picture.width, height = picture.height;
    const GpuScene gpuScene(scene);
    const gl::UniformBuffer block =
        frameBuffer(makeFrame(picture.camera, width, height, gpuScene.bounds(), 1));
    bindFrame(block);
    const Lighting lighting(picture.level, gpuScene, picture.environment);
    const GBuffer gbuffer(width, height, {true, true, {}, gpuScene.emits()});
    GBufferPass().draw(gpuScene, makeFrame(picture.camera, width, height, gpuScene.bounds(), 1),
                       gbuffer);
    const LightBuffers light(width, height, lighting.hasDirect());
    lighting.draw(gbuffer, light);
    Composite composite(View{}, picture.level, width, height, false);
    composite.draw(light, gl::constantTexture({picture.visibility, 0, 0, 0}), false, 0,
                   gbuffer.emission());
    Drawn drawn{width,
                height,
                vectorsOf(gbuffer.albedo(), width, height),
                vectorsOf(*gbuffer.shadingNormal(), width, height),
                {},
                gl::readFloats(gbuffer.depth(), width, height, gl::Format::r32f),
                vectorsOf(light.ambient(), width, height),
                {},
                vectorsOf(composite.sum(), width, height)};
    for (glm::vec4& albedo : drawn.albedo) // read back as code values
        for (int c = 0; c < 3; ++c)
            albedo[c] = linearFromSrgb(albedo[c]);
    if (gbuffer.emission())
        drawn.emission = vectorsOf(*gbuffer.emission(), width, height);
    if (light.hasDirect())
        drawn.direct = vectorsOf(light.direct(), width, height);
    return drawn;
}

// A square of 2 m around the origin that faces +z, and a camera that sees nothing else.
inline Scene square(const Material& material = {}) {
    Scene scene;
    addQuad(scene,
            {glm::vec3(-1, -1, 0), glm::vec3(1, -1, 0), glm::vec3(1, 1, 0), glm::vec3(-1, 1, 0)});
    for (std::size_t i = 0; i < 4; ++i)
        scene.vertices[i].uv = {i == 1 || i == 2 ? 1 : 0, i < 2 ? 1 : 0};
    scene.materials[0] = material;
    return scene;
}
inline Camera towardsSquare() {
    Camera camera;
    camera.position = {0, 0, 2};
    camera.fovDegrees = 30;
    return camera;
}

inline Level constantLight(Vec3 radiance) {
    Level level;
    level.ambient = radiance;
    level.curve = Curve::clamp;
    return level;
}
inline Level evenSky(double radiance) {
    Level level;
    level.sky = Sky{{radiance, radiance, radiance},
                    {radiance, radiance, radiance},
                    {radiance, radiance, radiance}};
    level.curve = Curve::clamp;
    return level;
}

} // namespace obscura
