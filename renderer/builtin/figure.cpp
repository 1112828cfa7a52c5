#include "renderer/builtin/figure.h"

#include "base/parallel.h"
#include "renderer/builtin/atlas.h"
#include "renderer/builtin/noise.h"
#include "renderer/builtin/textures.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

// A body's surface with what is known at each of its vertices.
struct Survey {
    Shape shape;
    std::vector<int> parts;
    std::vector<float> open;
};

Survey surveyOf(const Body& body) {
    Survey survey{meshOf(body, false), {}, {}};
    survey.shape.add(meshOf(body, true));
    const std::vector<Vertex>& vertices = survey.shape.vertices;
    survey.parts.resize(vertices.size());
    survey.open.resize(vertices.size());
    forEachInParallel(vertices.size(), [&](std::size_t i) {
        survey.parts[i] = static_cast<int>(nearestPart(body, vertices[i].position).part);
        survey.open[i] = openness(body, vertices[i]);
    });
    return survey;
}

} // namespace

float distanceTo(const Body& body, glm::vec3 p) { return nearestPart(body, p).distance; }

Figure modelled(const Body& body) {
    Survey survey = surveyOf(body);
    Shape& shape = survey.shape;
    std::vector<float> density;
    for (const BodyPart& part : body)
        density.push_back(part.fine && part.radius < 0.3F ? 2.0F : 1.0F); // faces and hands
    const std::vector<std::uint32_t> origin = unwrap(shape, survey.parts, density);
    const Noise noise("builtin/brush");
    const auto brush = [&](const std::array<std::uint32_t, 3>& t, glm::vec3 weights) {
        glm::vec3 p(0), colour(0);
        float openHere = 0;
        for (int k = 0; k < 3; ++k)
            p += weights[k] * shape.vertices[t[static_cast<std::size_t>(k)]].position;
        for (int k = 0; k < 3; ++k) { // so that colours run into each other within a triangle
            const std::uint32_t vertex = origin[t[static_cast<std::size_t>(k)]];
            openHere += weights[k] * survey.open[vertex];
            colour += weights[k] * body[static_cast<std::size_t>(survey.parts[vertex])].colour(p);
        }
        return painted(colour, openHere, noise.value(p * 60.0F) + 0.5F * noise.value(p * 160.0F));
    };
    Image8 colours = paintAtlas(shape, atlasSize, brush);
    return {std::move(shape), std::move(colours)};
}

} // namespace obscura::builtin
