#pragma once

#include "renderer/frame/gbuffer.h"
#include "renderer/techniques/settings.h"

#include <functional>
#include <optional>
#include <vector>

namespace obscura {

// Draws one more layer of a view's depth: GBufferPass::peel() of the scene that is looked at.
using Peel = std::function<void(const Frame& frame, const gl::Texture& before, float separation,
                                const gl::Target& layer)>;

// Both must outlive it.
Peel peelOf(const GBufferPass& pass, const GpuScene& scene);

// The parameter `layers` says how many layers of depth a technique reads; these are those beyond
// the first. A layer lies at least `layerSeparation` radii (before radiusMultiplier, so that fits
// peel alike) behind the one before: nearer things, such as both sides of a leaf, the links of a
// chain or a picture on its wall, block nearly the same directions, and a layer for each would be
// wasted. In radii, so that what is scaled together stays the same. Mara et al. 2016, "Deep
// G-buffers", has the idea; docs/reference.md has what other separations give.
constexpr float layerSeparation = 0.1f;
int furtherLayers(const Settings& settings);

// The second and third layer, drawn anew for each picture as a program does whose camera moves; so
// their cost is the technique's own.
class FurtherLayers {
  public:
    FurtherLayers(int count, int width, int height);

    void resize(int width, int height);
    // `first`: linear view depth of the first layer.
    void draw(const Peel& peel, const Frame& frame, const gl::Texture& first,
              float separation) const;
    // 0: the second. Linear view depth as in GBuffer::depth().
    const gl::Texture& depth(int further) const {
        return targets_[static_cast<std::size_t>(further)]->colour(0);
    }
    int count() const { return static_cast<int>(targets_.size()); }

    // As a PassObserver is told of them. A pixel fetches the layer before for each surface there.
    static constexpr Pass pass{.name = "layers",
                               .format = gl::Format::r32f,
                               .work = Work::prepare,
                               .fetches = [](const Settings& s) { return 1.0 * furtherLayers(s); }};
    static double bytesPerPixel(int count); // linear depth, and a depth buffer for each

  private:
    std::vector<std::optional<gl::Target>> targets_;
};

} // namespace obscura
