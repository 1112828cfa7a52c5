#pragma once

#include "renderer/reference/reference.h"

#include <optional>

namespace obscura {

// The integrals of renderer/reference/reference.h traced against the depth buffer alone, by brute
// force: what is hidden or off the screen does not exist. How far surfaces go on behind what is
// seen of them, no depth buffer of one layer says: `thickness` assumes it, and decides how far this
// is from RayTracer (docs/reference.md). Techniques that assume better can be nearer.
//
// A ray is walked pixel by pixel; between pixels the surface is taken as plane (inverse depth is
// interpolated, which is exact on planes). Without `thickness` everything behind the surface is
// solid; with it, only that many metres along the view axis. What leaves the screen is open. A ray
// shorter than a pixel on screen meets nothing. Pixels without a normal (0, 0, 0) block rays, but
// no rays start from them.
Reference depthReference(const Surfaces& surfaces, const TraceSettings& settings,
                         std::optional<double> thickness = {}, const TraceProgress& progress = {});

} // namespace obscura
