#pragma once

#include "renderer/settings.h"

namespace obscura {

// Sample points for shaders, by a technique's settings.

// `samples` points (xyz) spread evenly over the volume of the unit ball: the R3 sequence (Roberts
// 2018), which has no clumps at 8 points and converges at 4096.
std::vector<glm::vec4> ballPoints(const Settings& settings);

} // namespace obscura
