#pragma once

#include "gl/target.h"
#include "renderer/frame/gbuffer.h"

#include <memory>

namespace obscura {

// What the technique rtao reads (Reads::traced, renderer/techniques/technique.h): cosine-weighted
// visibility within a radius by few rays a pixel, traced on all cores from the points and normals
// of a G-buffer.
//
// The rays of a pixel are successive points of the R2 sequence along a Hilbert curve
// (shaders/ao/rtao.glsl), so that those of neighbours, which a filter takes together, are spread
// evenly too. They share nothing with a reference's, which are scrambled Sobol points.
class FewRays {
  public:
    // Embree's own form of the scene is made when visibility is first asked for.
    explicit FewRays(std::shared_ptr<const Scene> scene);
    ~FewRays();
    FewRays(FewRays&&) noexcept;

    // Visibility in red, 1 open, 0 blocked; empty pixels are open. The radius is in metres; the
    // frame is the G-buffer's, its seeds move along the sequence. Good until the next call.
    const gl::Texture& operator()(const GBuffer& gbuffer, const Frame& frame, float radius,
                                  int rays) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace obscura
