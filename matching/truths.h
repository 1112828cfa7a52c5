#pragma once

#include "protocols/reader/match.h"
#include "renderer/probe.h"
#include "renderer/reference/reference.h"

#include <filesystem>
#include <optional>

namespace obscura {

// What techniques are compared with on a view, made once and kept in the cache of references.

// A ray tracer of a scene that is made only when a truth is not in the cache. The scene must
// outlive it.
class LazyTracer {
  public:
    explicit LazyTracer(const Scene& scene) : scene_(scene) {}
    const RayTracer& get();

  private:
    const Scene& scene_;
    std::optional<RayTracer> tracer_;
};

struct TruthInputs {
    View view; // its radius is the integral's
    ImageSize size;
    int rays = 256; // per pixel
    Normals normals = Normals::smooth;
    std::uint64_t seed = 0;
};

// `probe` sees that view at that size. The one place that knows how each truth is made: the depth
// buffer's has surfaces as thick as the radius (docs/reference.md says why).
Image truthOf(Truth truth, const TruthInputs& inputs, const Probe& probe, LazyTracer& tracer,
              const std::string& sceneSha256, const std::filesystem::path& cache,
              const TraceProgress& progress = {});

// "cosine", the name in tables.
std::string nameOf(Truth truth);

// Roughly how many seconds a truth takes on two cores.
double truthCost(const ImageSize& size, int rays);

} // namespace obscura
