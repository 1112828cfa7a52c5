#pragma once

#include "renderer/gbuffer.h"
#include "renderer/settings.h"

#include <optional>

namespace obscura {

// The assembled fragment shader of a technique's pass: frame, settings, samplers, the technique's
// file, and a main that calls the pass's function.
gl::ShaderText passShader(const Technique& technique, const Pass& pass);

// A technique's passes over a G-buffer of one size: depth (and normals) in, visibility out.
class OcclusionPasses {
  public:
    OcclusionPasses(const Settings& settings, int width, int height);

    // Visibility in red, 1 open, 0 blocked; empty pixels are open. The frame must be bound. The
    // texture lives as long as this object.
    const gl::Texture& visibility(const GBuffer& gbuffer) const;

  private:
    struct Step {
        gl::Program program;
        gl::Target target;
        int unit; // that later passes read it from
    };
    std::vector<Step> steps_;
    gl::UniformBuffer settings_;
    std::optional<gl::UniformBuffer> points_;
    gl::Texture open_; // what a technique without passes shows
    gl::ScreenTriangle triangle_;
};

} // namespace obscura
