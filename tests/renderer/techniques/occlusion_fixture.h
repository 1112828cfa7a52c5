#pragma once

#include "image/image.h"
#include "renderer/reference/few_rays.h"
#include "renderer/reference/traced.h"
#include "renderer/reference/triangle_tree.h"
#include "renderer/scene/proxies.h"
#include "renderer/scene/quads.h"
#include "renderer/techniques/occlusion_passes.h"
#include "renderer/techniques/settings.h"
#include "tests/renderer/gl_test.h"

#include <optional>

namespace obscura {

// Constant white light from everywhere, for techniques that read light.
inline Level whiteLight() {
    Level level;
    level.ambient = Vec3{1, 1, 1};
    return level;
}

// What a technique's passes leave: visibility, and the light to add where it has any. Top row
// first. `accumulated` frames were before this one (Frame::seed.y).
inline Image occlusionOf(const Scene& scene, const Camera& camera, const Settings& settings,
                         int width, int height, std::uint64_t seed = 1,
                         Normals kind = Normals::smooth, const Level& level = whiteLight(),
                         std::vector<glm::vec4> proxies = {}, int accumulated = 0) {
    const GpuScene gpuScene(scene);
    const int guard = guardPixels(settings, height);
    Frame frame = makeFrame(camera, width, height, gpuScene.bounds(), seed, {0, 0}, guard);
    frame.seed.y = accumulated;
    const gl::UniformBuffer block = frameBuffer(frame);
    bindFrame(block);
    if (settings.technique().reads & rays)
        return tracedVisibility(RayTracer(scene), surfacesOf(gpuScene, GBufferPass(), frame, kind),
                                settings, seed);
    const int fullWidth = width + 2 * guard, fullHeight = height + 2 * guard;
    const Lighting lighting(level, gpuScene, std::filesystem::path());
    const GBuffer gbuffer(fullWidth, fullHeight,
                          {true, lighting.readsNormals(), normalsFor(settings.technique(), kind)});
    const GBufferPass gbufferPass;
    gbufferPass.draw(gpuScene, frame, gbuffer);
    const LightBuffers light(fullWidth, fullHeight, lighting.hasDirect());
    lighting.draw(gbuffer, light);
    std::optional<ProxySpheres> fitted;
    const auto spheres = [&]() -> const ProxySpheres& {
        if (!fitted)
            fitted.emplace(proxies.empty() ? proxySpheres(scene, 256) : proxies);
        return *fitted;
    };
    const SceneOccluders occluders(scene);
    const std::shared_ptr<const Scene> geometry(std::shared_ptr<void>(), &scene); // not its own
    const FewRays traced(geometry);
    const SceneTriangles triangles(geometry);
    const OcclusionPasses passes(settings, fullWidth, fullHeight);
    const gl::Texture& texture =
        passes.visibility({gbuffer, frame,
                           [&] {
                               return OcclusionInputs::Light{light, lighting};
                           },
                           spheres, peelOf(gbufferPass, gpuScene), &occluders, std::cref(triangles),
                           std::cref(traced)});
    const int channels = passes.sendsLight() ? 4 : 1;
    Image image{width, height, channels, {}};
    if (settings.technique().passes.empty()) {
        image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                            1.0f);
        return image;
    }
    const std::vector<float> values = gl::readFloats(
        texture, fullWidth, fullHeight, channels == 4 ? gl::Format::rgba32f : gl::Format::r32f);
    for (int y = guard + height - 1; y >= guard; --y) {
        const auto row = values.begin() + (y * fullWidth + guard) * channels;
        image.pixels.insert(image.pixels.end(), row, row + width * channels);
    }
    return image;
}

// Visibility alone: 1 channel.
inline Image visibilityOf(const Scene& scene, const Camera& camera, const Settings& settings,
                          int width, int height, std::uint64_t seed = 1, int accumulated = 0) {
    Image image = occlusionOf(scene, camera, settings, width, height, seed, Normals::smooth,
                              whiteLight(), {}, accumulated);
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < image.pixels.size() / channels; ++i)
        image.pixels[i] = image.pixels[i * channels];
    image.pixels.resize(image.pixels.size() / channels);
    image.channels = 1;
    return image;
}

} // namespace obscura
