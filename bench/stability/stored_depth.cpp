#include "bench/stability/stored_depth.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>

namespace obscura {

float halfFloatDepth(float depth) { return glm::unpackHalf1x16(glm::packHalf1x16(depth)); }

float fixedPointDepth(float depth) {
    constexpr double most = (1 << 24) - 1, near = 0.1;
    const double code = std::round((1 - near / static_cast<double>(depth)) * most);
    return static_cast<float>(near / (1 - std::clamp(code, 0.0, most - 1) / most));
}

} // namespace obscura
