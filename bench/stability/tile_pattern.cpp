#include "bench/stability/tile_pattern.h"

#include <algorithm>
#include <cmath>

namespace obscura {

Image withDiagonalsLevelled(const Image& image, const Selection& patch) {
    const auto diagonals = static_cast<std::size_t>(image.width + image.height);
    std::vector<double> sums(diagonals), counts(diagonals);
    const auto diagonal = [&](std::size_t i) {
        const auto width = static_cast<std::size_t>(image.width);
        return i % width + static_cast<std::size_t>(image.height) - i / width;
    };
    for (std::size_t i = 0; i < patch.size(); ++i)
        if (patch[i]) {
            sums[diagonal(i)] += static_cast<double>(image.pixels[i]);
            ++counts[diagonal(i)];
        }
    Image result = image;
    for (std::size_t i = 0; i < patch.size(); ++i)
        if (patch[i])
            result.pixels[i] = static_cast<float>(sums[diagonal(i)] / counts[diagonal(i)]);
    return result;
}

TilePattern tilePattern(const Image& image, const Image& levelled, const Selection& patch,
                        int period) {
    const auto phases = static_cast<std::size_t>(period * period);
    std::vector<double> sums(phases), counts(phases);
    double energy = 0, count = 0;
    for (std::size_t i = 0; i < patch.size(); ++i)
        if (patch[i]) {
            const int x = static_cast<int>(i) % image.width, y = static_cast<int>(i) / image.width;
            const auto phase = static_cast<std::size_t>(y % period * period + x % period);
            const double grain = static_cast<double>(image.pixels[i] - levelled.pixels[i]);
            sums[phase] += grain;
            ++counts[phase];
            energy += grain * grain;
            ++count;
        }
    double repeated = 0;
    for (std::size_t phase = 0; phase < phases; ++phase)
        if (counts[phase] > 0)
            repeated += sums[phase] * sums[phase] / counts[phase];
    const double chance = static_cast<double>(phases) / count;
    const double ordered = std::max(repeated - chance * energy, 0.0) / (1 - chance);
    return {std::sqrt(ordered / count), energy > 0 ? ordered / energy : 0};
}

} // namespace obscura
