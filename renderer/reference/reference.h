#pragma once

#include "image/image.h"
#include "renderer/frame/surfaces.h"
#include "renderer/reference/trace_settings.h"
#include "renderer/scene/scene.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace obscura {

// Ground truth: visibility by ray tracing the scene's triangles (Embree) from the G-buffer's own
// points. docs/techniques.md says what it is the truth of.

// Rows from top to bottom; empty pixels are open.
struct Reference {
    Image visibility; // 1 channel
    Image error;      // 1 channel: standard error of visibility (reference.cpp says how)
    Image bentNormal; // 3 channels: mean unblocked direction, unit, view space; the normal where
                      // everything is blocked
};

// Names the version of Embree, since another may give other numbers for the same surfaces and
// settings. Our own code has a hash (reference_cache.h).
std::string rayTracerVersion();

// Called now and then with the share done, 0 ... 1, from the calling thread.
using TraceProgress = std::function<void(double)>;

class RayTracer {
  public:
    // Copies what it needs: triangles, and the holes of masked materials.
    explicit RayTracer(const Scene& scene);
    ~RayTracer();
    RayTracer(RayTracer&&) noexcept;

    // On all cores. Rays that a tilted normal sends below the face count as blocked.
    Reference trace(const Surfaces& surfaces, const TraceSettings& settings,
                    const TraceProgress& progress = {}) const;

  private:
    struct Device;
    std::unique_ptr<Device> device_;
};

} // namespace obscura
