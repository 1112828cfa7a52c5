#pragma once

#include "protocols/reader/study.h"

namespace obscura {

// How a camera is moved by hand: functions of a camera and of what the hand did. Angles are
// radians. All keep the camera's `up`, and never let it look straight along that; the focus
// distance (from position to target) changes only where that is the point.

double focusDistance(const Camera& camera); // metres

// Turns the head: to the right, and up. The position stays.
Camera looked(const Camera& camera, double right, double up);

// Moves camera and target by so many metres along its own right, `up`, and where it looks.
Camera flown(const Camera& camera, double right, double up, double forward);

// Carries the camera round the target, which stays: to the right and up as the hand drags the
// scene, so that what is seen turns the same way.
Camera orbited(const Camera& camera, double right, double up);

// Shifts camera and target so that what lies at the target moves across the picture by these shares
// of its height: to the right, and up.
Camera panned(const Camera& camera, double right, double up);

// Multiplies the distance from the target, which stays.
Camera dollied(const Camera& camera, double factor);

// Multiplies the size of what the picture shows at the target, by the field of view alone, within 1
// to 120 degrees.
Camera zoomed(const Camera& camera, double factor);

// Metres per second: what a scene of that diagonal is explored with, and what so many notches of a
// wheel make of a speed.
double walkingSpeed(double diagonal);
double nextSpeed(double speed, double notches);

} // namespace obscura
