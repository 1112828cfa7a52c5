#pragma once

#include "renderer/scene/scene.h"

namespace obscura {

// Spheres that stand for a scene's surfaces seen from afar: world position and radius (metres), at
// most `count` of them. What they promise:
// - every point of every triangle lies inside one of them (to rounding);
// - a round body gets a sphere of its size (more, where it stands so close to other things that it
//   is split from them across), a wall gets spheres centred on the wall, which reach about
//   sqrt(area / count) to either side of it, area being that of the scene; where detail is finer
//   than that, centres may lie in the air before it;
// - the same scene gives the same spheres, and scaling it scales them.
std::vector<glm::vec4> proxySpheres(const Scene& scene, int count = 1024);

} // namespace obscura
