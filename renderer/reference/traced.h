#pragma once

#include "renderer/reference/reference.h"
#include "renderer/techniques/settings.h"

namespace obscura {

// The technique ray_traced (renderer/techniques/rows/traced.h): it has no passes over a G-buffer;
// these functions give its visibility.

TraceSettings traceSettings(const Settings& settings, std::uint64_t seed);

// Visibility as the last pass of another technique would leave it, intensity and power applied
// (renderer/techniques/technique.h). 1 channel.
Image tracedVisibility(const RayTracer& tracer, const Surfaces& surfaces, const Settings& settings,
                       std::uint64_t seed);

// What the last pass of another technique would make of visibility: intensity and power applied.
Image shaped(Image visibility, const Settings& settings);

// The visibility as a texture that the composite can read.
gl::Texture visibilityTexture(const Image& visibility);

} // namespace obscura
