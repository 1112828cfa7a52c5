#pragma once

#include "renderer/techniques/settings.h"

namespace obscura {

// Points of the unit disc (xy) for VAO++: the Poisson sets of 2, 4, 8, 16 and 32 points in one
// array of 62 (poisson_sets.h; the set of n begins at n - 2). Where `samples` is none of these
// numbers, `samples` points of Vogel's spiral (1979) follow, so that tests can approach the limit
// of infinitely many samples.
std::vector<glm::vec4> poissonDiscPoints(const Settings& settings);

} // namespace obscura
