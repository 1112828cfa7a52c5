#pragma once

#include "renderer/techniques/settings.h"

namespace obscura {

// Points of the unit disc (xy) for VAO++: the Poisson sets of 2, 4, 8, 16 and 32 points in one
// array of 62 (poisson_sets.h; the set of n begins at n - 2). Where `samples` is no such number,
// that many more follow on Vogel's spiral (1979), for limits of infinitely many samples.
std::vector<glm::vec4> poissonDiscPoints(const Settings& settings);

} // namespace obscura
