#pragma once

#include "renderer/builtin/implicit.h"

#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace obscura::builtin {

// A body as a list of solids with colours of their own.
struct BodyPart {
    Field solid;
    glm::vec3 centre; // of a ball that holds it
    float radius;
    std::function<glm::vec3(glm::vec3)> colour; // sRGB code values by place, before occlusion
    float blend = 0.01F;                        // fillet with the parts before it
    bool fine = false; // a head or hand: a finer mesh and texture than clothes need
};
using Body = std::vector<BodyPart>;

float distanceTo(const Body& body, glm::vec3 p);

// The body's surface and its own texture, into whose colours its occlusion is painted, as the
// thesis' game characters had it: creases and folds are dark before any light is computed.
struct Figure {
    Shape shape;
    Image8 colours;
};
Figure modelled(const Body& body);

} // namespace obscura::builtin
