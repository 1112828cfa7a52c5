#pragma once

#include "renderer/builtin/shapes.h"

#include <glm/glm.hpp>

#include <functional>
#include <initializer_list>

namespace obscura::builtin {

// A solid as a function of space: metres to its surface, negative inside. It may fall short of the
// true distance, and may exceed it by a third (carved detail does).
using Field = std::function<float(glm::vec3)>;

// The surface of a solid within a box, by naive surface nets (Gibson 1998): one vertex in each cell
// of `cell` metres that the surface crosses, moved onto the surface, with the field's gradient as
// normal. Shared vertices throughout; no texture coordinates.
Shape surfaceOf(const Field& field, const Bounds& box, float cell);

// Towards the outside, not unit length where the field is not a true distance.
glm::vec3 gradient(const Field& field, glm::vec3 p, float step);

// Union and cut with a fillet of about `blend` metres (Quilez, "Smooth minimum").
float merge(float a, float b, float blend);
float cut(float solid, float hole, float blend);

float ellipsoid(glm::vec3 p, glm::vec3 radii);
float roundedBox(glm::vec3 p, glm::vec3 half, float radius);
// From a with radius ra to b with radius rb.
float limb(glm::vec3 p, glm::vec3 a, glm::vec3 b, float ra, float rb);
// The same as data: modelling is mostly a list of these.
struct Limb {
    glm::vec3 from, to;
    float fromRadius, toRadius;
    float blend; // fillet with what was there before
};
float withLimbs(float solid, glm::vec3 p, std::initializer_list<Limb> limbs);

glm::vec3 turned(glm::vec3 p, int axis, float degrees); // about the origin

} // namespace obscura::builtin
