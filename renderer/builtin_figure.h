#pragma once

#include "renderer/builtin_implicit.h"

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

// Adds the body to the scene with a texture of its own, into whose colours its occlusion is
// painted, as the thesis' game characters had it: creases and folds are dark before any light is
// computed.
void addFigure(Scene& scene, const char* name, const Body& body, const glm::mat4& place);

// Parts of a person who faces +z, feet at the origin; metres. x and -x are alike where nothing else
// is said.
float face(glm::vec3 p); // about the origin, in the middle of the head
float hand(glm::vec3 p); // wrist at the origin, fingers curling from +y towards +z; a right one
// A gown's half widths (x, z) at heights, from hem to neck.
struct Girth {
    float height;
    glm::vec2 half;
};
float gown(glm::vec3 p, const std::vector<Girth>& girths);
// Drapery from a cord at the top: how far the cloth stands out, -1 in a valley to 0 on a ridge.
float folds(float angle, float height, float count);

} // namespace obscura::builtin
