#include "renderer/frame/composite.h"

#include <cmath>

namespace obscura {

gl::ShaderText compositeShader() { return shaderText("composite.frag"); }

Composite::Composite(const View& view, const Level& level, int width, int height, bool linear)
    : program_("composite", shaderText("screen.vert"), compositeShader()),
      sum_(width, height, std::vector<gl::Format>(linear ? 2 : 1, gl::Format::rgba32f), false,
           "sum of frames") {
    restart();
    set(view, level);
}

void Composite::set(const View& view, const Level& level) {
    program_.set("exposure", static_cast<float>(std::exp2(view.exposure)));
    program_.set("curve", static_cast<int>(level.curve));
    program_.set("white", static_cast<float>(level.white));
    program_.set("occludeDirect", level.occludeDirect ? 1 : 0);
}

void Composite::restart() { frames_ = 0; }

void Composite::draw(const LightBuffers& light, const gl::Texture& visibility, bool sendsLight,
                     int guard, const gl::Texture* emission) {
    sum_.bind();
    gl::State state;
    state.add = frames_ > 0; // the first takes the place of what was there
    state.apply();
    program_.use();
    program_.set("sendsLight", sendsLight ? 1 : 0);
    program_.set("guard", guard);
    program_.set("hasDirect", light.hasDirect() ? 1 : 0);
    program_.set("hasEmission", emission ? 1 : 0);
    gl::bindTexture(0, light.ambient());
    gl::bindTexture(1, light.direct());
    gl::bindTexture(2, visibility);
    if (emission)
        gl::bindTexture(3, *emission);
    triangle_.draw();
    ++frames_;
}

std::vector<float> Composite::mean(int colour) const {
    std::vector<float> values =
        gl::readFloats(sum_.colour(colour), sum_.width(), sum_.height(), sum_.format(colour));
    for (float& value : values)
        value /= static_cast<float>(frames_);
    return values;
}

} // namespace obscura
