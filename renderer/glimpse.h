#pragma once

#include "renderer/reference/sight.h"

namespace obscura {

// What a small picture (27 pixels high, aspect: width / height) says about its camera.
struct Glimpse {
    double shown = 0;   // share of the pixels that show a surface
    double variety = 0; // bits: entropy of the kinds of surface, by area in the picture
    // Of depth: the nearest, the twentieth part, the median; metres.
    double first = 0, near = 0, middle = 0;
};

// Variety counts surfaces that can be told apart: by material, the way they face, and distance in
// sizes of the scene. After the entropy of viewpoints (Vazquez, Feixas, Sbert and Heidrich 2001,
// "Viewpoint selection using viewpoint entropy"), which counts faces and so depends on how finely a
// scene is cut.
Glimpse glimpse(const Sight& sight, const Camera& camera, double aspect, double size);

// What there is around a place, in directions evenly spread.
struct Around {
    double closed = 0;  // share of directions, but for those far down, that meet something drawn
    double backs = 0;   // share of all that meet a back first: inside of something solid, or of a
                        // shell that is to be seen from outside, it is most
    double nearest = 0; // metres
};

Around around(const Sight& sight, const glm::vec3& eye);

} // namespace obscura
