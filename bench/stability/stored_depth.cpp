#include "bench/stability/stored_depth.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace obscura {

namespace {

constexpr double codes = (1 << 24) - 1, near = 0.1;

} // namespace

float halfFloatDepth(float depth) { return glm::unpackHalf1x16(glm::packHalf1x16(depth)); }

// From 2^k to 2^(k + 1) there are 2^10 of them, so that the first are the farthest apart.
Probe::StoredDepth halfFloatDepths() { return {halfFloatDepth, {0x1p-10f, 0}}; }

float fixedPointDepth(float depth) {
    const double code = std::round((1 - near / static_cast<double>(depth)) * codes);
    return static_cast<float>(near / (1 - std::clamp(code, 0.0, codes - 1) / codes));
}

// A code c stands for z = n / (1 - c / N), so dz = z^2 / (n N). Read as floats, they are rounded
// again.
Probe::StoredDepth fixedPointDepths() {
    return {fixedPointDepth,
            {std::numeric_limits<float>::epsilon(), static_cast<float>(1 / (near * codes))}};
}

} // namespace obscura
