#include "renderer/builtin/implicit.h"
#include "renderer/builtin/scenes.h"
#include "renderer/builtin/serpent.h"

#include <algorithm>
#include <cmath>

namespace obscura::builtin {

namespace {

constexpr float cell = 0.0066F; // of the surface net: a scale is about five cells wide

// Round the foot of the stone, up its side, in at the front of its hollow, out at the back, and
// over its shoulder. The front is +z.
Serpent serpent() {
    return Serpent({
        {{0.335F, 0.075F, 0.10F}, 0.008F},  {{0.22F, 0.085F, 0.27F}, 0.018F},
        {{0.02F, 0.095F, 0.335F}, 0.028F},  {{-0.20F, 0.105F, 0.28F}, 0.037F},
        {{-0.335F, 0.110F, 0.08F}, 0.044F}, {{-0.32F, 0.120F, -0.15F}, 0.050F},
        {{-0.10F, 0.135F, -0.31F}, 0.054F}, {{0.18F, 0.17F, -0.28F}, 0.058F},
        {{0.33F, 0.25F, -0.10F}, 0.060F},   {{0.31F, 0.34F, 0.12F}, 0.061F},
        {{0.14F, 0.415F, 0.235F}, 0.061F},  {{0.00F, 0.440F, 0.09F}, 0.060F},
        {{-0.03F, 0.455F, -0.11F}, 0.058F}, {{-0.11F, 0.495F, -0.26F}, 0.056F},
        {{-0.26F, 0.570F, -0.16F}, 0.055F}, {{-0.25F, 0.650F, 0.06F}, 0.053F},
        {{-0.09F, 0.715F, 0.17F}, 0.051F},  {{0.10F, 0.775F, 0.10F}, 0.050F},
        {{0.14F, 0.860F, -0.06F}, 0.049F},  {{0.04F, 0.950F, -0.13F}, 0.047F},
        {{-0.04F, 1.005F, -0.03F}, 0.045F}, {{-0.06F, 1.000F, 0.07F}, 0.045F},
    });
}

// An upright pebble with twisted flutes, one great hollow right through and a smaller one across.
float stone(glm::vec3 p) {
    const glm::vec3 q = p - glm::vec3(0, 0.37F, 0);
    float d = ellipsoid(q, {0.265F, 0.385F, 0.22F});
    if (d > 0.06F)
        return d;
    const float angle = std::atan2(q.x, q.z);
    const float wave = std::abs(std::sin(5.5F * angle + 5 * q.y));
    const float fade = std::min(1.0F, glm::length(glm::vec2(q.x, q.z)) / 0.13F); // towards the pole
    // Outside it fades: over a groove the ridges beside it are what is near.
    const float near = glm::clamp(1 - d / 0.05F, 0.0F, 1.0F);
    d += 0.034F * fade * near * (1 - std::sqrt(wave));
    const glm::vec3 through = turned(q - glm::vec3(0.01F, 0.06F, 0), 1, 8);
    d = cut(d, 0.14F * (glm::length(glm::vec2(through.x / 0.135F, through.y / 0.165F)) - 1), 0.05F);
    const glm::vec3 crossing = turned(q - glm::vec3(0, -0.19F, 0), 2, 20);
    d = cut(d, glm::length(glm::vec2(crossing.y, crossing.z)) - 0.075F, 0.04F);
    return d;
}

// A round slab with a hollow moulding, its foot on y = 0.
float base(glm::vec3 p) {
    const glm::vec2 q(glm::length(glm::vec2(p.x, p.z)), p.y - 0.03F);
    const glm::vec2 outside = glm::abs(q) - glm::vec2(0.40F, 0.03F) + 0.008F;
    const float slab = glm::length(glm::max(outside, 0.0F)) +
                       std::min(std::max(outside.x, outside.y), 0.0F) - 0.008F;
    return cut(slab, glm::distance(q, {0.405F, 0.002F}) - 0.014F, 0.006F);
}

} // namespace

Scene sculpture() {
    const Serpent animal = serpent();
    const Field field = [&](glm::vec3 p) {
        const float support = merge(stone(p), base(p), 0.03F);
        return std::max(merge(support, animal.distance(p), 0.008F), -p.y); // a flat foot
    };
    Shape shape = surfaceOf(field, {{-0.43F, -0.02F, -0.43F}, {0.43F, 1.25F, 0.43F}}, cell);
    Scene scene;
    scene.materials.push_back({.name = "clay", .baseColour = glm::vec4(0.55F, 0.53F, 0.50F, 1)});
    addMesh(scene, shape, 0);
    return scene;
}

} // namespace obscura::builtin
