#include "metrics/sensitivity.h"

#include "metrics/sensitivity_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace obscura {

namespace {

constexpr float darkest = 0.005F, brightest = 10000;
constexpr double lowest = 0.1, highest = 64; // cycles per degree
// A float's bits, but for its last 16, count eighths of an octave's sixteenths: 128 an octave.
constexpr int lastBits = 16;
constexpr std::uint32_t firstNode = std::bit_cast<std::uint32_t>(darkest) >> lastBits,
                        lastNode = std::bit_cast<std::uint32_t>(brightest) >> lastBits;

// Where a value lies on an axis of nodes that are even in its logarithm.
struct Place {
    std::size_t below = 0;
    double share = 0; // of the way to the next node
};
Place placeOn(double low, double high, double value) {
    const double at = (sensitivityNodes - 1) * std::log(std::clamp(value, low, high) / low) /
                      std::log(high / low);
    const double below = std::min(std::floor(at), sensitivityNodes - 2.0);
    return {static_cast<std::size_t>(below), at - below};
}

double logSensitivity(std::size_t channel, std::size_t row, const Place& column) {
    const float* node =
        &sensitivityTable[(channel * sensitivityNodes + row) * sensitivityNodes + column.below];
    return static_cast<double>(node[0]) +
           column.share * (static_cast<double>(node[1]) - static_cast<double>(node[0]));
}

} // namespace

Sensitivity::Sensitivity(double cyclesPerDegree) {
    const Place column = placeOn(lowest, highest, cyclesPerDegree);
    for (std::uint32_t node = firstNode; node <= lastNode + 1; ++node) {
        const auto luminance = static_cast<double>(std::bit_cast<float>(node << lastBits));
        const Place row =
            placeOn(static_cast<double>(darkest), static_cast<double>(brightest), luminance);
        std::array<float, 3>& values = nodes_.emplace_back();
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double below = logSensitivity(channel, row.below, column),
                         above = logSensitivity(channel, row.below + 1, column);
            values[channel] = static_cast<float>(std::pow(10, below + row.share * (above - below)));
        }
    }
}

std::array<float, 3> Sensitivity::at(float luminance) const {
    const auto bits = std::bit_cast<std::uint32_t>(std::clamp(luminance, darkest, brightest));
    const float share = static_cast<float>(bits & ((1U << lastBits) - 1)) / (1U << lastBits);
    const std::array<float, 3>* node = &nodes_[(bits >> lastBits) - firstNode];
    std::array<float, 3> values;
    for (std::size_t channel = 0; channel < 3; ++channel)
        values[channel] = node[0][channel] + share * (node[1][channel] - node[0][channel]);
    return values;
}

} // namespace obscura
