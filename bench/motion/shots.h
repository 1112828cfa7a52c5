#pragma once

#include "bench/motion/temporal_measures.h"
#include "renderer/probe.h"
#include "renderer/reference/reference.h"

#include <map>
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
    // noise. Its truth is left empty. One that accumulates has looked at it for as many frames as
    // it accumulates.
    Shot take(const Camera& camera, std::uint64_t seed, std::span<const std::size_t> which) const;
    // The same of the next frame: what accumulates goes on from the last one.
    Shot next(const Camera& camera, std::uint64_t seed, std::span<const std::size_t> which) const;
    // What those that accumulate would show if they had looked at this view alone for as many
    // frames as they accumulate. What they go on from stays.
    std::vector<Image> stills(const Camera& camera, std::uint64_t seed,
                              std::span<const std::size_t> which) const;
    Image truth(const Surfaces& surfaces, const TraceSettings& settings) const;

  private:
    using Visibility = Image (Probe::*)(const Settings&, OcclusionPasses&, int) const;
    Shot shoot(const Camera& camera, std::uint64_t seed, std::span<const std::size_t> which,
               Visibility visibility) const;

    Subject subject_;
    RayTracer tracer_;
    std::span<const NamedSettings> configurations_;
    int width_, height_;
    mutable std::vector<OcclusionPasses> passes_;             // of each configuration
    mutable std::map<std::size_t, OcclusionPasses> stillers_; // made when first asked for
};

// What happened between two shots, both of which must have their truth.
FrameStep stepBetween(const Shot& before, const Shot& now);

} // namespace obscura
