#include "renderer/reference/traced.h"

#include <algorithm>
#include <cmath>

namespace obscura {

TraceSettings traceSettings(const Settings& settings, std::uint64_t seed) {
    TraceSettings result;
    result.integral = static_cast<Integral>(static_cast<int>(settings["integral"]));
    result.radius = static_cast<double>(settings["radius"] * settings["radiusMultiplier"]);
    result.rays = static_cast<int>(settings["rays"]);
    result.seed = seed;
    return result;
}

Image shaped(Image visibility, const Settings& settings) {
    const float power = settings["power"], intensity = std::copysign(settings["intensity"], power);
    for (float& value : visibility.pixels)
        value = std::min(std::pow(std::max(1 - intensity * (1 - value), 0.0f), power), 1.0f);
    return visibility;
}

Image tracedVisibility(const RayTracer& tracer, const Surfaces& surfaces, const Settings& settings,
                       std::uint64_t seed) {
    return shaped(tracer.trace(surfaces, traceSettings(settings, seed)).visibility, settings);
}

gl::Texture visibilityTexture(const Image& visibility) {
    std::vector<float> rows; // from the bottom
    const auto width = static_cast<std::ptrdiff_t>(visibility.width);
    for (std::ptrdiff_t y = visibility.height - 1; y >= 0; --y)
        rows.insert(rows.end(), visibility.pixels.begin() + y * width,
                    visibility.pixels.begin() + (y + 1) * width);
    return gl::floatTexture(visibility.width, visibility.height, rows);
}

} // namespace obscura
