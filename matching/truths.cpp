#include "matching/truths.h"

#include "renderer/reference/depth_reference.h"
#include "renderer/reference/reference_cache.h"

#include <fmt/format.h>

namespace obscura {

namespace {

Integral integralOf(Truth truth) {
    switch (truth) {
    case Truth::uniform:
        return Integral::uniform;
    case Truth::falloff:
        return Integral::falloff;
    default:
        return Integral::cosine;
    }
}

} // namespace

const RayTracer& LazyTracer::get() {
    if (!tracer_)
        tracer_.emplace(scene_);
    return *tracer_;
}

Image truthOf(Truth truth, const TruthInputs& inputs, const Probe& probe, LazyTracer& tracer,
              const std::string& sceneSha256, const std::filesystem::path& cache,
              const TraceProgress& progress) {
    ReferenceInputs reference;
    reference.sceneSha256 = sceneSha256;
    reference.camera = inputs.view.camera;
    reference.width = inputs.size.width;
    reference.height = inputs.size.height;
    reference.normals = inputs.normals;
    reference.settings.integral = integralOf(truth);
    reference.settings.radius = inputs.view.radius;
    reference.settings.rays = inputs.rays;
    reference.settings.seed = inputs.seed;
    if (truth == Truth::depth) {
        const double thickness = reference.settings.radius;
        return cachedReference(cache,
                               fmt::format("{}-depth-{:a}", referenceKey(reference), thickness),
                               [&] {
                                   return depthReference(probe.surfaces(), reference.settings,
                                                         thickness, progress);
                               })
            .visibility;
    }
    return cachedReference(
               cache, referenceKey(reference),
               [&] { return tracer.get().trace(probe.surfaces(), reference.settings, progress); })
        .visibility;
}

std::string nameOf(Truth truth) { return truthNames()[static_cast<std::size_t>(truth)]; }

double truthCost(const ImageSize& size, int rays) {
    return 1.0 * size.width * size.height * rays / 3e6;
}

} // namespace obscura
