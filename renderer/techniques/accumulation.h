#pragma once

#include "renderer/frame/gbuffer.h"
#include "renderer/techniques/technique.h"

#include <optional>

namespace obscura {

// Temporal accumulation (`accumulate`, technique.h): a running mean of a technique's visibility
// over frames whose noise differs, carried along with the surfaces of a static scene. Each pixel's
// point is looked up in the frame before, by both cameras (reverse reprojection: Nehab, Sander,
// Lawrence, Tatarchuk and Isidoro 2007). What those of the four pixels around show that lie on its
// surface, within half a pixel's width of its tangent plane, is its history, weighted bilinearly;
// the others and what lies outside of the image are not. A frame then weighs 1 / n where the
// history is a mean of n - 1 of them, up to `frames`, from where on the mean is an exponential one.
// So `frames` frames before a still camera give their mean, and what had been hidden begins anew.
class Accumulation {
  public:
    // Of visibility with 1 or 4 channels.
    Accumulation(int frames, int channels, int width, int height);

    // For images of another size, without compiling anything; forgets.
    void resize(int width, int height);
    // The next frame is the first again.
    void forget();
    // How many frames there have been, modulo `cycle`: what the next frame's noise differs by
    // (Frame::seed.y).
    int frame() const { return frame_; }
    static constexpr int cycle = 64; // XeGTAO's

    // Adds a frame's visibility to the mean, which lives until the next call but one. `frame` is
    // the one that is bound, `gbuffer` what it shows.
    const gl::Texture& add(const gl::Texture& visibility, const GBuffer& gbuffer,
                           const Frame& frame);

    // As a PassObserver is told of it. Fetches the depth of the pixel and its four neighbours, its
    // visibility, and depth and mean of four pixels of the frame before.
    static constexpr Pass pass{.name = "accumulate",
                               .format = gl::Format::r32f,
                               .work = Work::filter,
                               .fetches = [](const Settings&) { return 5.0 + 1 + 2 * 4; }};
    static gl::ShaderText shader();
    // Of GPU memory for each pixel: two means, each with its depth and its number of frames.
    static constexpr double bytes(int channels) { return 2.0 * 4 * (channels + 2); }

  private:
    int frame_ = 0;
    gl::Program program_;
    std::array<gl::Target, 2> means_; // the newest is [0]; depth and number of frames beside it
    std::optional<Frame> before_;
    gl::ScreenTriangle triangle_;
};

} // namespace obscura
