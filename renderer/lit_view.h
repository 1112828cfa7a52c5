#pragma once

#include "renderer/frame/composite.h"
#include "renderer/probe.h"

namespace obscura {

// One view of a subject under a level's light, to be put together with any visibility: what error
// is left of a technique's once there is light and colour. Without anti-aliasing, as in a Probe.
class LitView {
  public:
    // `protocolFolder` is where environment images are.
    LitView(const Subject& subject, const View& view, const Level& level,
            const std::filesystem::path& protocolFolder, int width, int height, std::uint64_t seed);

    // sRGB. Visibility has one channel, rows from the top, and the view's size.
    Image8 image(const Image& visibility);

  private:
    int width_, height_;
    Lighting lighting_;
    GBuffer gbuffer_;
    LightBuffers light_;
    Composite composite_;
};

} // namespace obscura
