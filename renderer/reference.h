#pragma once

#include "renderer/image.h"
#include "renderer/scene.h"
#include "renderer/surfaces.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace obscura {

// Ground truth: visibility by ray tracing the scene's triangles (Embree) from the G-buffer's own
// points. docs/techniques.md says what it is the truth of.

// Which integral over the hemisphere Omega around the normal n; V is 1 where nothing is met within
// the radius R, t the distance of the nearest thing met.
enum class Integral {
    cosine,  // 1/pi  int V (n.w) dw
    uniform, // 1/2pi int V dw
    falloff  // 1/pi  int min(t/R, 1) (n.w) dw: 1 - t/R of an occluder counts
};

// "cosine", "uniform", "falloff", in the order of the enumeration.
const std::vector<std::string>& integralNames();

struct TraceSettings {
    Integral integral = Integral::cosine;
    double radius = 0.5; // R, metres
    int rays = 256;      // per pixel; rounded up to a power of two, at least 2
    std::uint64_t seed = 1;
    int threads = 0; // 0: all cores. The result does not depend on it
    // The rays of all pixels leave their normals in the same directions. Errors are then no noise
    // but a pattern on the surfaces, which a moving camera leaves where it is; they may be alike in
    // many pixels, so `error` says nothing about means.
    bool sameRays = false;
};

// Rows from top to bottom; empty pixels are open.
struct Reference {
    Image visibility; // 1 channel
    Image error;      // 1 channel: standard error of visibility (reference.cpp says how)
    Image bentNormal; // 3 channels: mean unblocked direction, unit, view space; the normal where
                      // everything is blocked
};

// Changes when the same surfaces and settings give other numbers.
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
