#include "viewer/meter.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace obscura {

double meteredExposure(const Image8& picture, Curve curve, double exposure) {
    std::array<double, 256> linear{};
    for (std::size_t code = 0; code < linear.size(); ++code)
        linear[code] = static_cast<double>(linearFromSrgb(static_cast<float>(code) / 255));
    double sum = 0;
    for (std::size_t i = 0; i + 2 < picture.pixels.size(); i += 3) {
        double luminance = 0.2126 * linear[picture.pixels[i]] +
                           0.7152 * linear[picture.pixels[i + 1]] +
                           0.0722 * linear[picture.pixels[i + 2]];
        luminance = std::clamp(luminance, 1e-4, 0.98);
        if (curve == Curve::reinhard) // x / (1 + x); the others change little of what is dark
            luminance /= 1 - luminance;
        sum += std::log2(luminance);
    }
    const auto pixels = static_cast<double>(picture.pixels.size() / 3);
    const double stops = pixels > 0 ? std::log2(0.18) - sum / pixels : 0;
    return std::clamp(std::round((exposure + stops) * 2) / 2, -8.0, 8.0);
}

} // namespace obscura
