#pragma once

#include "renderer/frame/gbuffer.h"
#include "renderer/techniques/settings.h"

namespace obscura {

// Lets a technique run on every nth pixel across and down (`downscale`, technique.h). First a
// smaller G-buffer takes the picked pixels as they are; it does not average them, because the
// average of two depths is a point on neither surface. Afterwards each pixel that was left out gets
// its visibility from those of the four picked pixels around it that lie on its own surface (joint
// bilateral upsampling, Kopf et al. 2007, weighted by distance from the pixel's plane in depth).
class Reduction {
  public:
    // `width` and `height` are the full size; `normals` says whether normals are picked too.
    // `format` is that of the visibility that is upsampled and of the result.
    Reduction(int factor, bool normals, int width, int height, gl::Format format);

    // The same for images of another full size, without compiling anything.
    void resize(int width, int height);

    int width() const { return picked_.width(); }
    int height() const { return picked_.height(); }

    // Draws the smaller buffers from the full ones and binds the frame that fits them. `frame` is
    // the one that is bound.
    void reduce(const GBuffer& gbuffer, const Frame& frame);
    const gl::Texture& depth() const { return picked_.colour(0); }
    const gl::Texture* normals() const { // null where none are picked
        return picked_.count() > 1 ? &picked_.colour(1) : nullptr;
    }
    // The full frame is bound again.
    const gl::Texture& upsample(const gl::Texture& visibility, const GBuffer& gbuffer);

    // The two passes, as a PassObserver is told of them.
    static constexpr Pass reducePass{.name = "reduce",
                                     .format = gl::Format::r32f,
                                     .work = Work::prepare,
                                     .fetches = [](const Settings& s) {
                                         return s.technique().reads & Reads::normals ? 2.0 : 1.0;
                                     }};
    // Fetches two quads of depth, and the depths and values of four picked pixels.
    static constexpr Pass upsamplePass{.name = "upsample",
                                       .format = gl::Format::r16f,
                                       .work = Work::upsample,
                                       .fetches = [](const Settings&) { return 4.0; }};
    static gl::ShaderText reduceShader();
    static gl::ShaderText upsampleShader();

  private:
    int factor_;
    gl::Program reduce_, upsample_;
    gl::Target picked_, full_;
    std::optional<gl::UniformBuffer> reducedFrame_, fullFrame_;
    Frame frame_{};
    gl::ScreenTriangle triangle_;
};

// The frame of every nth pixel: its pixel p is pixel n p + n / 2 of the full one.
Frame reducedFrame(const Frame& frame, int factor);

} // namespace obscura
