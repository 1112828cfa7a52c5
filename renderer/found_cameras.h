#pragma once

#include "renderer/reference/reference.h"

#include <span>
#include <string>
#include <vector>

namespace obscura {

class Sight;

// Cameras that see a scene where there is something to see, for measurements in scenes of which
// nobody has said where to stand (renderer/framing.h has one view, for people). Candidates stand
// within the scene, looking level, and around it, looking in; of those whose picture is filled, not
// nearer than `radius` (metres, of occlusion), and occluded here and there (a few rays per pixel),
// the ones far apart are taken, the most interesting first. The same scene and seed give the same
// cameras. An Error when there are too few.
std::vector<Camera> foundCameras(const Sight& sight, const RayTracer& tracer, double radius,
                                 int count, std::uint64_t seed);

// How far occlusion is to reach in a scene of which nobody has said it: 1, 2 or 5 times a power of
// ten, nearest to a sixteenth of the height of what cameras see at their median depth. That is
// small enough for techniques to gather from nearby pixels (34 of 540) and for the picture's
// borders to matter little, and large enough to be seen. Where the scene is hardly occluded within
// it, it is doubled (to a quarter of the height at most), and where most of it is dark, halved, as
// long as that lasts and helps. Studies
// take radii from 0.1 mm to 10 km, so it is one of these.
struct SuggestedRadius {
    double metres = 0;
    std::string why;
};
// Of cameras that see something.
SuggestedRadius suggestedRadius(const Sight& sight, const RayTracer& tracer,
                                std::span<const Camera> cameras);
// Of so many that are found for the scene and are not close to anything. An Error where there are
// none.
SuggestedRadius suggestedRadius(const Sight& sight, const RayTracer& tracer, int cameras,
                                std::uint64_t seed);

// 1, 2 or 5 times a power of ten, nearest by ratio; of `metres` above 0.
double roundRadius(double metres);

} // namespace obscura
