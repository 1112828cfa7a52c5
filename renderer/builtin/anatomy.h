#pragma once

#include "renderer/builtin/figure.h"

#include <glm/glm.hpp>

#include <cmath>
#include <functional>
#include <span>

// What the figures' bodies and clothes are made of: fields as in implicit.h, in metres, of people
// who face +z with their feet at the origin; and the colours painted on them.
namespace obscura::builtin {

float face(glm::vec3 p); // about the origin, in the middle of the head
glm::vec3 faceColour(glm::vec3 p);
// The hand at `wrist`, fingers towards `point`, its palm towards `palm`.
struct HandPose {
    glm::vec3 wrist, point, palm;
    bool left = false;
};
float hand(glm::vec3 p, const HandPose& pose);
// From shoulder to wrist, hollow at its mouth.
struct Sleeve {
    glm::vec3 shoulder, elbow, wrist;
    float mouth; // radius
};
float sleeve(glm::vec3 p, const Sleeve& arm);

// A gown's half widths (x, z) at heights, from hem to neck.
struct Girth {
    float height;
    glm::vec2 half;
};
float gown(glm::vec3 p, std::span<const Girth> girths);
// Drapery from a cord at the top: how far the cloth stands out, -1 in a valley to 0 on a ridge.
float folds(float angle, float height, float count);

inline float angleOf(glm::vec3 p) { return std::atan2(p.x, p.z); } // 0 in front
inline glm::vec3 mirrored(glm::vec3 p) { return {std::abs(p.x), p.y, p.z}; }

namespace paint { // sRGB code values
constexpr glm::vec3 skin{0.80F, 0.60F, 0.48F}, linen{0.86F, 0.80F, 0.68F},
    gold{0.80F, 0.60F, 0.24F};
constexpr glm::vec3 leather{0.40F, 0.26F, 0.17F}, steel{0.62F, 0.65F, 0.68F};
} // namespace paint
std::function<glm::vec3(glm::vec3)> plain(glm::vec3 colour);
// Cloth with a golden border at the height `hem`, 4 cm wide, and a thin line above it.
std::function<glm::vec3(glm::vec3)> bordered(glm::vec3 colour, float hem);

} // namespace obscura::builtin
