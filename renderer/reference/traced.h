#pragma once

#include "renderer/reference/reference.h"
#include "renderer/techniques/settings.h"

namespace obscura {

// The technique ray_traced (rows/traced.h): what passes over a G-buffer are to other techniques.

TraceSettings traceSettings(const Settings& settings, std::uint64_t seed);

// Visibility as the last pass of another technique would leave it, intensity and power applied
// (technique.h). 1 channel.
Image tracedVisibility(const RayTracer& tracer, const Surfaces& surfaces, const Settings& settings,
                       std::uint64_t seed);

// For the composite to read.
gl::Texture visibilityTexture(const Image& visibility);

} // namespace obscura
