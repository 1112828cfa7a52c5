#pragma once

#include "renderer/render.h"

namespace obscura {

// Cameras that see a scene where there is something to see, for scenes of which nobody has said
// where to stand: `count` views of `like`'s scene and radius, named "camera-1" and so on.
// Candidates stand inside the scene's bounds, looking level, and around it, looking in; of those
// whose picture is filled, not too near, and occluded here and there (a few rays per pixel), the
// ones far apart are taken. The same scene and seed give the same cameras. An Error when there are
// too few.
std::vector<View> viewpoints(const View& like, const Folders& folders, int count,
                             std::uint64_t seed);

} // namespace obscura
