#include "renderer/builtin/furnishings.h"

#include "renderer/builtin/noise.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>

namespace obscura::builtin {

namespace {

// The left panel, whose rail is at y = height; tied back at 45 % of the height.
glm::vec3 curtainPoint(float width, float height, glm::vec2 uv) {
    const float down = uv.y, tie = 0.55F;
    const float gathered = down < tie ? ramp(0, tie, down) : 1 - 0.55F * ramp(tie, 1, down);
    const float across = width * (1 - 0.64F * gathered * (0.35F + 0.65F * ramp(0, 0.5F, down)));
    // Cloth keeps its length: where the panel is narrow its folds are deep.
    const float depth = 0.018F + 0.055F * (1 - across / width);
    const float pleats = 4.5F, wave = glm::two_pi<float>() * pleats * uv.x;
    const float drift = 0.9F * std::sin(3.1F * down + 4 * uv.x) + 0.4F * std::sin(7 * uv.x);
    const float sag = 0.35F * gathered * uv.x * uv.x * (down < tie ? 1 - down / tie : 0.0F);
    const float bulge = 0.09F * gathered * std::sin(glm::pi<float>() * uv.x);
    return {across * (uv.x + 0.012F * std::sin(2 * wave + drift)),
            height * (1 - down) - sag * height * 0.12F,
            depth * std::sin(wave + drift) + 0.3F * depth * std::sin(1.6F * wave + 2 * drift) +
                bulge};
}

} // namespace

Shape curtains(float width, float height) {
    const float half = 0.52F * width;
    // u runs against x, so that v, which runs down, leaves the outside towards +z.
    Shape panel = patch(
        [=](glm::vec2 uv) {
            return curtainPoint(half, height, {1 - uv.x, uv.y});
        },
        44, 40, {1.5F * half, 1});
    Shape shape;
    shape.add(panel, at({-width / 2, 0, 0}));
    glm::mat4 mirror = at({width / 2, 0, 0});
    mirror[0] = -mirror[0];
    shape.add(panel, mirror);
    return shape;
}

Shape banner(float width, float back, float front, const Ledge& ledge) {
    const float round = 0.16F, quarter = round * glm::half_pi<float>(); // over the rail
    const auto surface = [=](glm::vec2 uv) {
        const float s = glm::mix(-back, front, uv.y); // along the cloth, 0 on the rail
        const float hang = std::max(0.0F, std::abs(s) - quarter);
        const float angle = glm::clamp(s / round, -glm::half_pi<float>(), glm::half_pi<float>());
        const float free = s > 0 ? ramp(0, front, hang) : 0.0F;
        const float fold = (0.012F + 0.03F * free) * std::min(1.0F, 4 * hang) *
                           std::sin(20 * uv.x + 0.7F * std::sin(2 * s));
        const float out = s > 0 ? (ledge.out - round) * std::min(1.0F, hang / ledge.below) : 0.0F;
        return glm::vec3((0.5F - uv.x) * width * (1 - 0.05F * free),
                         round * (std::cos(angle) - 1) - hang,
                         round * std::sin(angle) + out + fold);
    };
    return patch(surface, 28, 36, {width, 1});
}

namespace {

// One handle: a ring of clay from neck to shoulder, in the plane z = 0.
Shape handle(glm::vec2 neck, glm::vec2 shoulder, float bow, float thickness) {
    std::vector<glm::vec3> path;
    for (int i = 0; i <= 16; ++i) {
        const float t = part(i, 16);
        const glm::vec2 straight = glm::mix(neck, shoulder, t);
        const float out = bow * std::sin(glm::pi<float>() * std::pow(t, 0.7F));
        path.push_back({straight.x + out, straight.y + 0.6F * out * (1 - t), 0});
    }
    const glm::vec2 centre = (neck + shoulder) / 2.0F - glm::vec2(0.5F, 0);
    return arch(circle(thickness, 10), path, {centre, 0});
}

void scale(Outline& outline, float factor) {
    for (glm::vec2& point : outline)
        point *= factor;
}

} // namespace

Shape amphora(float height) {
    Outline outline{{0, 0}, {0.10F, 0}, {0.12F, 0.015F}, {0.11F, 0.035F}, {0.075F, 0.06F}};
    for (int i = 1; i <= 16; ++i) { // the belly
        const float t = part(i, 16);
        outline.push_back(
            {0.075F + 0.175F * std::sin(glm::pi<float>() * std::pow(t, 0.85F) * 0.93F),
             0.06F + 0.62F * t});
    }
    addArc(outline, {0.155F, 0.80F}, 0.065F, 215, 160, 5);
    outline.insert(outline.end(), {{0.11F, 0.95F},
                                   {0.135F, 0.965F},
                                   {0.145F, 0.985F},
                                   {0.135F, 1.0F},
                                   {0.105F, 0.99F},
                                   {0.085F, 0.94F},
                                   {0.08F, 0.8F},
                                   {0, 0.78F}});
    scale(outline, height);
    Shape shape = lathe(outline, 24);
    for (const float turn : {0.0F, 180.0F})
        shape.add(handle(glm::vec2(0.10F, 0.90F) * height, glm::vec2(0.19F, 0.62F) * height,
                         0.11F * height, 0.018F * height),
                  at({0, 0, 0}, turn));
    return shape;
}

Shape urn(float height) {
    Outline outline{{0, 0}, {0.30F, 0}, {0.30F, 0.05F}, {0.27F, 0.07F}};
    addArc(outline, {0.27F, 0.16F}, 0.13F, 230, 140, 5);
    outline.insert(outline.end(), {{0.20F, 0.25F}, {0.22F, 0.28F}});
    addArc(outline, {0.16F, 0.52F}, 0.26F, -68, 30, 8);
    addArc(outline, {0.47F, 0.76F}, 0.13F, 218, 130, 5);
    outline.insert(outline.end(), {{0.46F, 0.90F},
                                   {0.48F, 0.93F},
                                   {0.48F, 0.97F},
                                   {0.45F, 1.0F},
                                   {0.38F, 1.0F},
                                   {0.33F, 0.92F},
                                   {0.31F, 0.82F},
                                   {0, 0.84F}});
    scale(outline, height);
    return lathe(outline, 24);
}

Shape palm(int fronds, float length) {
    Shape shape;
    Random random(0, "builtin/palm");
    for (int i = 0; i < fronds; ++i) {
        const float inner = part(i, fronds); // the last ones stand upright in the middle
        const float reach = length * between(random, 0.85, 1.1),
                    lean = glm::mix(0.75F, 0.25F, inner);
        const float droop = between(random, 0.5, 0.9) * (1 - 0.5F * inner), width = 0.17F * length;
        const auto surface = [=](glm::vec2 uv) {
            const float t = uv.y, side = 2 * uv.x - 1;
            const float out = reach * (lean * t + 0.35F * droop * t * t);
            const float up = reach * (t * (1.15F - 0.4F * lean) - droop * t * t * t * 0.75F);
            const float fold = 0.35F * width * std::abs(side) * (1 - 0.6F * t); // a shallow V
            return glm::vec3(-width * side, up + fold, out - 0.4F * fold);
        };
        shape.add(patch(surface, 4, 12, {1, 1}),
                  at({0, 0, 0}, 360 * (part(i, 1) * 0.618F) + between(random, -12, 12)));
    }
    return shape;
}

Fountain fountain(float radius) {
    std::vector<glm::vec2> octagon;
    for (int i = 0; i < 8; ++i) {
        const float angle = glm::two_pi<float>() * (part(i, 8) + 0.0625F);
        octagon.push_back(radius * glm::vec2(std::sin(angle), std::cos(angle)));
    }
    Outline rim{{0.22F, 0}, {0.22F, 0.11F}, {0.20F, 0.12F}, {0.03F, 0.12F}, {0.03F, 0.2F}};
    addArc(rim, {0.09F, 0.28F}, 0.08F, 225, 130, 5);
    rim.push_back({0, 0.36F});
    rim.push_back({0, 0.50F});
    addArc(rim, {0.0F, 0.56F}, 0.06F, -80, 90, 6);
    rim.insert(rim.end(), {{-0.22F, 0.62F}, {-0.25F, 0.60F}, {-0.25F, 0.3F}});
    Fountain result;
    result.stone = moulding(rim, octagon);

    Outline stem{{0.34F, 0.3F}, {0.34F, 0.50F}};
    addArc(stem, {0.30F, 0.55F}, 0.05F, -90, 90, 4);
    addArc(stem, {0.30F, 0.70F}, 0.10F, 270, 180, 4);
    addArc(stem, {0.06F, 0.92F}, 0.17F, -50, 50, 6);
    stem.insert(stem.end(), {{0.10F, 1.12F}, {0.12F, 1.18F}, {0.2F, 1.22F}});
    addArc(stem, {0.0F, 2.02F}, 0.82F, -75, -42, 8); // the bowl's outside
    addArc(stem, {0.62F, 1.50F}, 0.04F, -30, 190, 6);
    addArc(stem, {0.0F, 2.02F}, 0.74F, -46, -72, 6);
    stem.insert(stem.end(), {{0.10F, 1.32F}, {0.07F, 1.42F}, {0.05F, 1.50F}});
    addArc(stem, {0.02F, 1.63F}, 0.10F, -60, 60, 6);
    addArc(stem, {0.0F, 1.82F}, 0.055F, -70, 90, 7);
    result.stone.add(lathe(stem, 36));
    result.water = lathe({{radius - 0.2F, 0.5F}, {0, 0.5F}}, 8);
    result.water.add(lathe({{0.64F, 1.475F}, {0, 1.475F}}, 32));
    return result;
}

Shape door(float radius, float springing) {
    Shape shape = box({2 * radius, 2 * springing + 2 * radius, 0.06F}, 0.004F);
    const float width = 0.5F * radius;
    for (const float side : {-1.0F, 1.0F}) {
        for (int row = 0; row < 4; ++row) {
            const float height = 0.22F * springing;
            const float y = (part(row, 1) + 0.55F) * 1.18F * height;
            const glm::vec3 centre(side * 0.5F * radius, y, 0.03F);
            shape.add(box({1.4F * width, height, 0.05F}, 0.02F), at(centre));
            shape.add(box({1.0F * width, 0.66F * height, 0.10F}, 0.03F), at(centre));
        }
        shape.add(
            lathe({{0.05F, 0}, {0.04F, 0.03F}, {0.02F, 0.05F}, {0.02F, 0.07F}, {0, 0.08F}}, 12),
            glm::rotate(at({side * 0.08F, 0.62F * springing, 0.03F}), glm::half_pi<float>(),
                        glm::vec3(1, 0, 0)));
    }
    shape.add(box({0.05F, 2 * (springing + radius), 0.10F}, 0.012F));
    projectUv(shape);
    for (Vertex& vertex : shape.vertices)
        vertex.uv = {vertex.uv.y, vertex.uv.x}; // boards upright
    return shape;
}

} // namespace obscura::builtin
