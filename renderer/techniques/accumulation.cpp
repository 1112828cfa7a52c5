#include "renderer/techniques/accumulation.h"

#include <glm/gtc/type_ptr.hpp>

#include <utility>

namespace obscura {

namespace {

gl::Target meanTarget(int channels, int width, int height) {
    return gl::Target(
        width, height,
        std::array{channels == 4 ? gl::Format::rgba32f : gl::Format::r32f, gl::Format::rg32f},
        false, "accumulated visibility");
}

// From the view space of one frame to that of another; nothing moves by rounding alone.
glm::mat4 viewFromView(const Frame& to, const Frame& from) {
    return to.viewFromWorld == from.viewFromWorld ? glm::mat4(1)
                                                  : to.viewFromWorld * from.worldFromView;
}

} // namespace

gl::ShaderText Accumulation::shader() { return shaderText("accumulate.frag"); }

Accumulation::Accumulation(int frames, int channels, int width, int height)
    : program_("accumulate", shaderText("screen.vert"), shader()),
      means_{meanTarget(channels, width, height), meanTarget(channels, width, height)} {
    program_.set("frames", static_cast<float>(frames));
}

void Accumulation::resize(int width, int height) {
    for (gl::Target& mean : means_)
        mean = meanTarget(gl::channelsOf(mean.format(0)), width, height);
    forget();
}

void Accumulation::forget() {
    before_.reset();
    frame_ = 0;
}

const gl::Texture& Accumulation::add(const gl::Texture& visibility, const GBuffer& gbuffer,
                                     const Frame& frame) {
    std::swap(means_[0], means_[1]);
    if (!before_)
        means_[1].clear(1, {0, 0, 0, 0}); // a mean of no frames
    const Frame& before = before_ ? *before_ : frame;
    program_.use();
    program_.setMatrix("beforeFromView",
                       std::span<const float, 16>(glm::value_ptr(viewFromView(before, frame)), 16));
    program_.set("beforeFromUv", std::span<const float, 4>(glm::value_ptr(before.viewFromUv), 4));
    gl::bindTexture(0, gbuffer.depth());
    gl::bindTexture(1, visibility);
    gl::bindTexture(2, means_[1].colour(0));
    gl::bindTexture(3, means_[1].colour(1));
    gl::State().apply();
    means_[0].bind();
    triangle_.draw();
    before_ = frame;
    frame_ = (frame_ + 1) % cycle;
    return means_[0].colour(0);
}

} // namespace obscura
