#pragma once

#include "protocols/reader/study.h"
#include "renderer/reference/reference.h"

#include <cstdint>
#include <string>

namespace obscura {

// A view that shows a scene, for a person who opens it and has not said where to stand.
//
// Where the scene is a room, the camera stands in it: at eye height (1.6 m where the room is high
// enough) on a floor where there is one, looking level to where there is most to tell apart. A room
// is a scene that is closed around somebody in it, of which he sees more than can be seen from
// outside. All else is seen from outside, in three-quarter view and slightly above (more, where it
// is flat), the whole of it in the picture, from the side that shows most, its front (+z, as glTF
// has it) preferred.
//
// A camera of the file's own is preferred to both where it sees enough: who made the scene knew
// what to show. Where a file has several, it is the first such; its angle is kept.
//
// What is far away from everything else, or several times as large as everything else together,
// does not count (renderer/extent.h).
struct Framing {
    // With `near`, and looking at the middle of what it shows: its target is there.
    Camera camera;
    // Where the camera begins to see, metres: 1, 2 or 5 times a power of ten near a thousandth of
    // the size of what is shown, but well before the nearest surface in the picture.
    double near = 0;
    double radius = 0; // of occlusion, metres (suggestedRadius)
    bool inside = false;
    std::string why; // all of it in words: whole sentences
    // What the whole of an object needs in a picture of another shape: the narrowest that it is all
    // in, and how far from the camera its farthest point is, metres; 0 where the camera stays.
    double narrowest = 0, farthest = 0;
};

// The same scene, seed and aspect (width / height of the picture) give the same view. Needs no
// OpenGL; takes about a second on a scene of a million triangles. An Error where there is nothing
// to look at.
Framing framing(const Scene& scene, const RayTracer& tracer, std::uint64_t seed,
                double aspect = 16.0 / 9);

// The same view for a picture of another shape: where it is narrower, the camera steps back until
// all of an object is in it.
Camera fitted(const Framing& framing, double aspect);

} // namespace obscura
