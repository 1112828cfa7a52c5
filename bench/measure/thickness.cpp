#include "bench/measure/thickness.h"

#include "renderer/reference/depth_reference.h"

namespace obscura {

std::vector<ThicknessEffect> measureThickness(const Scene& scene, const Probe& probe,
                                              const TraceSettings& settings) {
    const Image truth = RayTracer(scene).trace(probe.surfaces(), settings).visibility;
    std::vector<ThicknessEffect> effects;
    for (const std::optional<double> radii :
         {std::optional<double>(), std::optional(0.25), std::optional(0.5), std::optional(1.0),
          std::optional(2.0)}) {
        std::optional<double> thickness;
        if (radii)
            thickness = *radii * settings.radius;
        const Image image = depthReference(probe.surfaces(), settings, thickness).visibility;
        effects.push_back({radii, imageError(image, truth, probe.shown())});
    }
    return effects;
}

} // namespace obscura
