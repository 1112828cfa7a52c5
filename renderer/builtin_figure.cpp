#include "renderer/builtin_figure.h"

#include "renderer/builtin_atlas.h"
#include "renderer/builtin_noise.h"
#include "renderer/builtin_parallel.h"
#include "renderer/builtin_textures.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace obscura::builtin {

namespace {

constexpr float clothCell = 0.0105F, fineCell = 0.0060F; // of the surface nets, metres
constexpr int atlasSize = 1024;

struct Nearest {
    float distance = 1e9F;
    std::size_t part = 0;
};

Nearest nearestPart(const Body& body, glm::vec3 p) {
    Nearest found;
    float least = 1e9F;
    for (std::size_t i = 0; i < body.size(); ++i) {
        const BodyPart& part = body[i];
        if (glm::distance(p, part.centre) - part.radius > found.distance + part.blend)
            continue;
        const float d = part.solid(p);
        if (d < least) {
            least = d;
            found.part = i;
        }
        found.distance = i == 0 ? d : merge(found.distance, d, part.blend);
    }
    return found;
}

// 1 in the open, 0 in a deep crease: how much nearer the surface comes than a plane would, a few
// steps out along the normal (Evans, "Fast approximations for global illumination", 2006).
float openness(const Body& body, const Vertex& vertex) {
    constexpr std::array<float, 4> steps{0.010F, 0.028F, 0.07F, 0.15F};
    float shade = 0;
    for (const float step : steps) {
        const float free = distanceTo(body, vertex.position + step * vertex.normal);
        shade += std::clamp(1 - free / step, 0.0F, 1.0F) / static_cast<float>(steps.size());
    }
    return 1 - shade;
}

Shape meshOf(const Body& body, bool fine) {
    Body parts;
    Bounds bounds{glm::vec3(1e9F), glm::vec3(-1e9F)};
    for (const BodyPart& part : body) {
        if (part.fine != fine)
            continue;
        parts.push_back(part);
        bounds.low = glm::min(bounds.low, part.centre - part.radius);
        bounds.high = glm::max(bounds.high, part.centre + part.radius);
    }
    const float cell = fine ? fineCell : clothCell;
    bounds.low.y = std::max(bounds.low.y, -2 * cell); // it stands on the floor
    return surfaceOf([&](glm::vec3 p) { return std::max(distanceTo(parts, p), -p.y); }, bounds,
                     cell);
}

// Warm shade in the creases, a rubbed light on the ridges, and the brush's own unevenness.
glm::vec3 painted(glm::vec3 colour, float open, float brush) {
    const float shade = glm::smoothstep(0.15F, 0.95F, open);
    const glm::vec3 dark = colour * glm::vec3(0.20F, 0.16F, 0.17F);
    const float worn = glm::smoothstep(0.92F, 1.0F, open);
    return glm::mix(dark, colour * (1 + 0.12F * worn), shade) * (1 + 0.10F * brush);
}

} // namespace

float distanceTo(const Body& body, glm::vec3 p) { return nearestPart(body, p).distance; }

void addFigure(Scene& scene, const char* name, const Body& body, const glm::mat4& place) {
    Shape shape = meshOf(body, false);
    shape.add(meshOf(body, true));
    std::vector<int> parts(shape.vertices.size());
    std::vector<float> open(shape.vertices.size()), density;
    onBothCores(parts.size(), [&](std::size_t i) {
        parts[i] = static_cast<int>(nearestPart(body, shape.vertices[i].position).part);
        open[i] = openness(body, shape.vertices[i]);
    });
    for (const BodyPart& part : body)
        density.push_back(part.fine && part.radius < 0.3F ? 2.0F : 1.0F); // faces and hands
    const std::vector<std::uint32_t> origin = unwrap(shape, parts, density);
    const Noise noise("builtin/brush");
    const auto brush = [&](const std::array<std::uint32_t, 3>& t, glm::vec3 weights) {
        glm::vec3 p(0), colour(0);
        float openHere = 0;
        for (int k = 0; k < 3; ++k)
            p += weights[k] * shape.vertices[t[static_cast<std::size_t>(k)]].position;
        for (int k = 0; k < 3; ++k) { // so that colours run into each other within a triangle
            const std::uint32_t vertex = origin[t[static_cast<std::size_t>(k)]];
            openHere += weights[k] * open[vertex];
            colour += weights[k] * body[static_cast<std::size_t>(parts[vertex])].colour(p);
        }
        return painted(colour, openHere, noise.value(p * 60.0F) + 0.5F * noise.value(p * 160.0F));
    };
    Material material{.name = name};
    material.baseColourTexture = addColourTexture(scene, paintAtlas(shape, atlasSize, brush));
    material.roughness = 0.75F;
    scene.materials.push_back(material);
    Shape placed;
    placed.add(shape, place);
    addMesh(scene, placed, static_cast<int>(scene.materials.size()) - 1);
}

float face(glm::vec3 p) {
    const glm::vec3 q(std::abs(p.x), p.y, p.z);
    float d = ellipsoid(p - glm::vec3(0, 0.020F, -0.008F), {0.074F, 0.092F, 0.090F}); // skull
    d = merge(d, ellipsoid(p - glm::vec3(0, -0.040F, 0.022F), {0.054F, 0.068F, 0.060F}), 0.03F);
    d = withLimbs(d, q, {{{0, -0.098F, 0.058F}, {0, -0.092F, 0.064F}, 0.017F, 0.014F, 0.03F},
                         {{0.008F, 0.026F, 0.084F}, {0.046F, 0.028F, 0.064F}, 0.010F, 0.008F, 0.016F}});
    d = cut(d, ellipsoid(q - glm::vec3(0.030F, 0.006F, 0.086F), {0.019F, 0.013F, 0.016F}), 0.014F);
    d = withLimbs(d, q, {{{0.045F, -0.022F, 0.052F}, {0.050F, -0.018F, 0.030F}, 0.014F, 0.012F, 0.02F},
                         {{0, 0.020F, 0.084F}, {0, -0.024F, 0.103F}, 0.008F, 0.012F, 0.012F}, // nose
                         {{0, -0.029F, 0.094F}, {0.012F, -0.029F, 0.086F}, 0.008F, 0.008F, 0.008F}});
    d = cut(d, limb(q, {0, -0.056F, 0.092F}, {0.022F, -0.058F, 0.080F}, 0.004F, 0.002F), 0.008F);
    d = withLimbs(d, q, {{{0, -0.050F, 0.083F}, {0.018F, -0.054F, 0.075F}, 0.006F, 0.003F, 0.006F},
                         {{0, -0.065F, 0.080F}, {0.014F, -0.063F, 0.075F}, 0.008F, 0.004F, 0.008F},
                         {{0.030F, 0.005F, 0.066F}, {0.030F, 0.006F, 0.066F}, 0.0135F, 0.0135F, 0.004F}});
    return merge(d, ellipsoid(q - glm::vec3(0.076F, 0, -0.006F), {0.011F, 0.027F, 0.017F}), 0.008F);
}

float hand(glm::vec3 p) {
    float d = limb(p * glm::vec3(1, 1, 1.5F), {0, -0.06F, 0}, {0, 0.01F, 0}, 0.030F, 0.026F);
    d = merge(d, ellipsoid(p - glm::vec3(0, 0.045F, 0), {0.040F, 0.046F, 0.017F}), 0.02F);
    for (int i = 0; i < 4; ++i) {
        const float x = 0.019F * (part(i, 1) - 1.5F), reach = i == 3 || i == 0 ? 0.85F : 1.0F;
        const glm::vec3 knuckle(x, 0.080F, 0.004F), middle(1.15F * x, 0.080F + 0.035F * reach, 0.018F);
        const glm::vec3 tip = middle + reach * glm::vec3(0, 0.012F, 0.036F);
        d = withLimbs(d, p, {{knuckle, middle, 0.0105F, 0.0095F, 0.006F},
                             {middle, tip, 0.0095F, 0.007F, 0.003F}});
    }
    return withLimbs(d, p, {{{-0.030F, 0.03F, 0.004F}, {-0.050F, 0.062F, 0.034F}, 0.014F, 0.009F, 0.012F}});
}

float gown(glm::vec3 p, const std::vector<Girth>& girths) {
    std::size_t i = 0;
    while (i + 2 < girths.size() && p.y > girths[i + 1].height)
        ++i;
    const Girth &a = girths[i], &b = girths[i + 1];
    const glm::vec2 half = glm::mix(
        a.half, b.half, glm::smoothstep(0.0F, 1.0F, (p.y - a.height) / (b.height - a.height)));
    const float around = (glm::length(glm::vec2(p.x, p.z) / half) - 1) * std::min(half.x, half.y);
    const float above = p.y - girths.back().height, below = girths.front().height - p.y;
    // 0.8: the sides slope.
    return std::max({0.8F * around, above, below});
}

float folds(float angle, float height, float count) {
    const float drift = 1.3F * std::sin(2 * angle + 0.7F) + 0.5F * std::sin(3.5F * height + angle);
    const float wave = std::sin(0.5F * (count * angle + drift));
    const float broad = std::sqrt(wave * wave + 0.015F); // valleys that a mesh can follow
    const float narrow = std::abs(std::sin(count * angle + 2.5F * drift + 2 * height));
    return -0.75F * (1 - std::sqrt(std::min(1.0F, broad))) - 0.25F * (1 - narrow);
}

} // namespace obscura::builtin
