#pragma once

#include "protocols/reader/protocol.h"

namespace obscura {

// How a camera moves in the tests of temporal stability: pure functions of the frame's number out
// of `frames`, frame 0 being `start`. Speeds are per frame: a longer path is not a slower one.

// Towards the target by 1/400 of the start's distance: at 60 frames a second and a target 10 m
// away, a brisk walk of 1.5 m/s.
Camera dollied(const Camera& start, int frame, int frames);
// Around the target by 0.2 degrees, about the camera's up.
Camera orbited(const Camera& start, int frame, int frames);
// On the spot by 0.1 degrees, about the camera's up.
Camera turned(const Camera& start, int frame, int frames);
// Still, but from frame `frames` / 2 on half-way to the target: a cut from a long shot to a closer
// one of the same things.
Camera cut(const Camera& start, int frame, int frames);

} // namespace obscura
