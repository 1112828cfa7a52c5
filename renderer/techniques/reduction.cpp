#include "renderer/techniques/reduction.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <cstring>

namespace obscura {

namespace {

int reduced(int size, int factor) { return (size + factor - 1) / factor; }

gl::Target pickedTarget(int factor, bool normals, int width, int height) {
    const std::array formats{gl::Format::r32f, gl::Format::rgba16f};
    return gl::Target(reduced(width, factor), reduced(height, factor),
                      std::span(formats).first(normals ? 2 : 1), false, "picked pixels");
}

gl::Target fullTarget(int width, int height, gl::Format format) {
    return gl::Target(width, height, std::array{format}, false, "upsampled visibility");
}

void drawOver(const gl::ScreenTriangle& triangle, const gl::Target& target) {
    gl::State().apply();
    target.bind();
    triangle.draw();
}

} // namespace

Frame reducedFrame(const Frame& frame, int factor) {
    const int width = reduced(static_cast<int>(frame.size.x), factor),
              height = reduced(static_cast<int>(frame.size.y), factor);
    // Full uv = reduced uv x scale + shift.
    const glm::vec2 scale = static_cast<float>(factor) * glm::vec2(width, height) *
                            glm::vec2(frame.size.z, frame.size.w);
    const float offCentre =
        static_cast<float>(factor / 2) + 0.5f - static_cast<float>(factor) / 2.0f; // pixels
    const glm::vec2 shift = offCentre * glm::vec2(frame.size.z, frame.size.w);
    Frame result = frame;
    result.size = glm::vec4(width, height, 1.0f / static_cast<float>(width),
                            1.0f / static_cast<float>(height));
    const glm::vec4& view = frame.viewFromUv;
    result.viewFromUv = glm::vec4(view.x * scale.x, view.y * scale.y, view.z + view.x * shift.x,
                                  view.w + view.y * shift.y);
    result.depth.w = frame.depth.w / scale.y;
    glm::mat4 reducedFromClip(1);
    for (int axis : {0, 1}) {
        reducedFromClip[axis][axis] = 1 / scale[axis];
        reducedFromClip[3][axis] = (1 - 2 * shift[axis]) / scale[axis] - 1;
    }
    result.clipFromView = reducedFromClip * frame.clipFromView;
    return result;
}

gl::ShaderText Reduction::reduceShader() { return shaderText("reduce.frag"); }
gl::ShaderText Reduction::upsampleShader() { return shaderText("upsample.frag"); }

Reduction::Reduction(int factor, bool normals, int width, int height, gl::Format format)
    : factor_(factor), reduce_("reduce", shaderText("screen.vert"), reduceShader()),
      upsample_("upsample", shaderText("screen.vert"), upsampleShader()),
      picked_(pickedTarget(factor, normals, width, height)),
      full_(fullTarget(width, height, format)) {
    reduce_.set("factor", factor);
    reduce_.set("hasNormals", normals ? 1 : 0);
    upsample_.set("factor", factor);
}

void Reduction::resize(int width, int height) {
    picked_ = pickedTarget(factor_, picked_.count() > 1, width, height);
    full_ = fullTarget(width, height, full_.format(0));
}

void Reduction::reduce(const GBuffer& gbuffer, const Frame& frame) {
    if (!fullFrame_ || std::memcmp(&frame, &frame_, sizeof frame) != 0) {
        frame_ = frame;
        fullFrame_.emplace(frameBuffer(frame));
        reducedFrame_.emplace(frameBuffer(reducedFrame(frame, factor_)));
    }
    reduce_.use();
    gl::bindTexture(0, gbuffer.depth());
    if (picked_.count() > 1)
        gl::bindTexture(1, *gbuffer.occlusionNormal());
    drawOver(triangle_, picked_);
    bindFrame(*reducedFrame_);
}

const gl::Texture& Reduction::upsample(const gl::Texture& visibility, const GBuffer& gbuffer) {
    bindFrame(*fullFrame_);
    upsample_.use();
    gl::bindTexture(0, gbuffer.depth());
    gl::bindTexture(1, picked_.colour(0));
    gl::bindTexture(2, visibility);
    drawOver(triangle_, full_);
    return full_.colour(0);
}

} // namespace obscura
