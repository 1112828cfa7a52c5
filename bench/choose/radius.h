#pragma once

#include "renderer/render.h"

#include <string>

namespace obscura {

// How far occlusion is to reach in a scene of which nobody has said it: 1, 2 or 5 times a power of
// ten, nearest to a sixteenth of the height of what cameras found for the scene (and not close to
// anything) see at their median depth. That is small enough for techniques to gather from nearby
// pixels (34 of 540) and for the picture's borders to matter little, and large enough to be seen.
// Where the scene is hardly occluded within it, it is doubled, and where most of it is dark,
// halved, as long as that lasts.
struct SuggestedRadius {
    double metres = 0;
    std::string why;
};
// `like`: the scene. An Error where no camera sees anything, as for viewpoints().
SuggestedRadius suggestedRadius(const View& like, const Folders& folders, int cameras,
                                std::uint64_t seed);

// 1, 2 or 5 times a power of ten, nearest by ratio; of `metres` above 0.
double roundRadius(double metres);

} // namespace obscura
