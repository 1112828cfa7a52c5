#pragma once

#include "metrics/image_error.h"
#include "renderer/probe.h"
#include "renderer/reference/reference.h"

#include <optional>
#include <vector>

namespace obscura {

// How far the depth buffer's reference is from that of the scene's triangles on one view, by the
// thickness that it gives to what the buffer shows.
struct ThicknessEffect {
    std::optional<double> radii; // none: infinite
    ImageError error;            // against the scene's reference
};
std::vector<ThicknessEffect> measureThickness(const Scene& scene, const Probe& probe,
                                              const TraceSettings& settings);

} // namespace obscura
