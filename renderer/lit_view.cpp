#include "renderer/lit_view.h"

#include "renderer/reference/traced.h"

namespace obscura {

LitView::LitView(const Subject& subject, const View& view, const Level& level,
                 const std::filesystem::path& protocolFolder, int width, int height,
                 std::uint64_t seed)
    : width_(width), height_(height),
      lighting_(level, subject.scene(), protocolFolder / level.environment),
      gbuffer_(width, height, {true, lighting_.readsNormals(), {}, subject.scene().emits()}),
      light_(width, height, lighting_.hasDirect()), composite_(view, level, width, height, false) {
    const Frame frame = makeFrame(view.camera, width, height, subject.scene().bounds(), seed);
    const gl::UniformBuffer block = frameBuffer(frame);
    bindFrame(block);
    subject.pass().draw(subject.scene(), frame, gbuffer_);
    lighting_.draw(gbuffer_, light_);
}

Image8 LitView::image(const Image& visibility) {
    composite_.restart();
    composite_.draw(light_, visibilityTexture(visibility), false, 0, gbuffer_.emission());
    return displayed(flipped(composite_.mean(), width_, height_, 4, 0, 3));
}

} // namespace obscura
