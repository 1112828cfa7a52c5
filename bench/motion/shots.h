#pragma once

#include "bench/motion/temporal_measures.h"
#include "renderer/probe.h"
#include "renderer/reference/reference.h"

#include <span>
#include <string>
#include <vector>

namespace obscura {

struct NamedSettings {
    std::string name; // what tells a configuration from others: "hbao", or "hbao steps=8"
    Settings settings;
};

// One camera's picture by several configurations.
struct Shot {
    Surfaces surfaces;
    std::vector<bool> shown; // as Probe::shown()
    std::vector<Image> visibilities;
    Image truth; // where it was asked for
};

// Takes pictures of a scene by many configurations: shaders are compiled once for all frames, and a
// frame's G-buffer is drawn once for all configurations.
class Shots {
  public:
    // The configurations must outlive it.
    Shots(const Scene& scene, std::span<const NamedSettings> configurations, int width, int height);

    // A picture by the configurations of these indices, in this order; `seed` is that of their
    // noise. Its truth is left empty.
    Shot take(const Camera& camera, std::uint64_t seed, std::span<const std::size_t> which) const;
    Image truth(const Surfaces& surfaces, const TraceSettings& settings) const;

  private:
    Subject subject_;
    RayTracer tracer_;
    std::span<const NamedSettings> configurations_;
    int width_, height_;
    mutable std::vector<OcclusionPasses> passes_; // of each configuration
};

// What happened between two shots, both of which must have their truth.
FrameStep stepBetween(const Shot& before, const Shot& now);

} // namespace obscura
