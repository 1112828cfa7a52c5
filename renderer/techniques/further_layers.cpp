#include "renderer/techniques/further_layers.h"

namespace obscura {

Peel peelOf(const GBufferPass& pass, const GpuScene& scene) {
    return [&](const Frame& frame, const gl::Texture& before, float separation,
               const gl::Target& layer) { pass.peel(scene, frame, before, separation, layer); };
}

int furtherLayers(const Settings& settings) {
    return settings.technique().reads & layers ? static_cast<int>(settings["layers"]) - 1 : 0;
}

FurtherLayers::FurtherLayers(int count, int width, int height)
    : targets_(static_cast<std::size_t>(count)) {
    resize(width, height);
}

void FurtherLayers::resize(int width, int height) {
    for (std::optional<gl::Target>& target : targets_)
        target.emplace(width, height, std::array{gl::Format::r32f}, true, "layer of depth");
}

void FurtherLayers::draw(const Peel& peel, const Frame& frame, const gl::Texture& first,
                         float separation) const {
    const gl::Texture* before = &first;
    for (const std::optional<gl::Target>& target : targets_) {
        peel(frame, *before, separation, *target);
        before = &target->colour(0);
    }
}

double FurtherLayers::bytesPerPixel(int count) {
    return count * (bytesOf(gl::Format::r32f) + bytesOf(gl::Format::depth32f));
}

} // namespace obscura
