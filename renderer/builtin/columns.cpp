#include "renderer/builtin/masonry.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace obscura::builtin {

namespace {

constexpr float taper = 0.84F; // a shaft's radius at the top, in radii at its foot

// Radius of a shaft with entasis: it narrows slowly at first.
float shaftRadius(float radius, float t) { return radius * (1 - (1 - taper) * std::pow(t, 1.7F)); }

// Two tori with a hollow between them: the Attic base, 0.9 radii high.
Outline atticBase(float r) {
    Outline outline;
    addArc(outline, {1.17F * r, 0.17F * r}, 0.17F * r, -90, 90, 6);
    outline.insert(outline.end(), {{1.16F * r, 0.34F * r}, {1.16F * r, 0.38F * r}});
    addArc(outline, {1.16F * r, 0.47F * r}, 0.09F * r, -90, -270, 5);
    outline.insert(outline.end(), {{1.16F * r, 0.60F * r}});
    addArc(outline, {1.10F * r, 0.68F * r}, 0.08F * r, -90, 90, 4);
    outline.insert(outline.end(), {{1.07F * r, 0.76F * r}, {1.07F * r, 0.80F * r}});
    addArc(outline, {1.10F * r, 0.90F * r}, 0.10F * r, -110, -180, 4);
    return outline;
}

// `flutes` hollows with narrow flats between them, ending in rounded tips.
Shape flutedShaft(float radius, float height, int flutes) {
    const auto surface = [=](glm::vec2 uv) {
        const float t = uv.y * uv.y * (3 - 2 * uv.y); // more rows at the ends
        const float off = std::abs(glm::fract(uv.x * part(flutes, 1)) - 0.5F) / 0.43F;
        const float fromEnd = std::min(t, 1 - t) * height / (0.2F * radius) - 0.6F;
        const float hollow =
            std::sqrt(std::max(0.0F, 1 - off * off)) * std::sqrt(glm::clamp(fromEnd, 0.0F, 1.0F));
        const float r = shaftRadius(radius, t) - 0.085F * radius * hollow;
        const float angle = glm::two_pi<float>() * uv.x;
        return glm::vec3(r * std::sin(angle), t * height, r * std::cos(angle));
    };
    return patch(surface, 6 * flutes, 10, {glm::two_pi<float>() * radius, height});
}

struct CapitalLeaf {
    float turn;  // degrees
    float width; // radians at its widest
    float foot, height, reach, radius;
};

// Rises along the bell, then rolls over outwards; lobed edges and a raised midrib. `thickness`
// gives its back, which is seen from above.
glm::vec3 leafPoint(const CapitalLeaf& leaf, glm::vec2 uv, float thickness) {
    const float side = 2 * uv.x - 1, bend = 0.66F;
    const float t = 1 - std::pow(1 - uv.y, 1.5F); // more rows where it rolls over
    const float roll = glm::radians(190.0F) * std::max(0.0F, t - bend) / (1 - bend);
    const float tip = std::max(0.0F, t - 0.4F) / 0.6F;
    const float narrow = std::sqrt(std::max(0.03F, 1 - tip * tip * tip));
    const float lobes = 1 + 0.10F * std::cos(glm::two_pi<float>() * 3.5F * t);
    const float angle = glm::radians(leaf.turn) + 0.5F * leaf.width * lobes * narrow * side;
    const float dish = leaf.radius * (0.10F - 0.09F * std::abs(side) - 0.03F * side * side);
    const float lift = dish - thickness * (1 - side * side);
    const float out = leaf.radius + 0.3F * leaf.reach * std::min(t, bend) / bend +
                      leaf.reach * (1 - std::cos(roll)) / 2 + lift * std::cos(roll);
    const float y = leaf.foot + leaf.height * std::min(t, bend) + leaf.reach * std::sin(roll) / 2 -
                    lift * std::sin(roll);
    return {out * std::sin(angle), y, out * std::cos(angle)};
}

Shape leafShape(const CapitalLeaf& leaf) {
    const float thickness = 0.09F * leaf.radius;
    const glm::vec2 metres(leaf.width * leaf.radius, leaf.height);
    Shape shape = patch([&](glm::vec2 uv) { return leafPoint(leaf, uv, 0); }, 6, 11, metres);
    shape.add(patch(
        [&](glm::vec2 uv) {
            return leafPoint(leaf, {1 - uv.x, uv.y}, thickness);
        },
        2, 8, metres));
    return shape;
}

// A ring of eight leaves, eight taller ones behind them, and a scroll under each corner.
Shape leaves(float r) {
    Shape shape;
    for (int i = 0; i < 8; ++i) {
        const float turn = 45 * part(i, 1);
        shape.add(leafShape({turn + 22.5F, 0.70F, 0, 1.05F * r, 0.26F * r, 1.00F * r * taper}));
        shape.add(leafShape({turn, 0.60F, 0.3F * r, 1.30F * r, 0.30F * r, 1.00F * r * taper}));
    }
    for (int i = 0; i < 4; ++i)
        shape.add(leafShape(
            {90 * part(i, 1) + 45, 0.36F, 0.7F * r, 0.86F * r, 0.58F * r, 1.08F * r * taper}));
    return shape;
}

// A square slab with a hollow below its edge.
Shape abacus(float width, float height) {
    const float half = width / 2;
    Outline outline{{-half, 0}, {-0.35F * height, 0}};
    addArc(outline, {-0.35F * height, 0.35F * height}, 0.35F * height, -90, 0, 5);
    outline.insert(outline.end(),
                   {{0.12F * height, 0.40F * height}, {0.12F * height, height}, {-half, height}});
    return pillar(outline, {width, width});
}

Shape plinth(float width, float height) {
    const float bevel = 0.06F * height;
    return pillar({{0, 0}, {0, height - bevel}, {-bevel, height}, {-width / 2, height}},
                  {width, width});
}

// Plinth, base and shaft; `top` is what they leave for the capital.
Shape grandCapital(float r, float top) {
    const float necking = taper * r, slab = 0.34F * r;
    Outline bell;
    addArc(bell, {necking, 0}, 0.07F * r, -90, 90, 6);
    bell.insert(bell.end(), {{0.98F * necking, 0.07F * r}, {0.98F * necking, 0.8F * (top - slab)}});
    addArc(bell, {necking + 0.5F * r, 0.8F * (top - slab)}, 0.5F * r, 180, 135, 5);
    bell.push_back({necking + 0.2F * r, top - slab});
    Shape shape = lathe(bell, 24);
    shape.add(leaves(r), at({0, 0.07F * r, 0}));
    shape.add(abacus(2.5F * r, slab), at({0, top - slab, 0}));
    return shape;
}

} // namespace

Shape grandColumn(float radius, float height) {
    const float foot = 0.42F * radius, base = foot + 0.9F * radius, top = 1.75F * radius;
    Shape shape = plinth(2.72F * radius, foot);
    shape.add(lathe(atticBase(radius), 24), at({0, foot, 0}));
    shape.add(flutedShaft(radius, height - top - base, 20), at({0, base, 0}));
    shape.add(grandCapital(radius, top), at({0, height - top, 0}));
    return shape;
}

Shape plainColumn(float radius, float height) {
    const float foot = 0.5F * radius, base = foot + 0.9F * radius;
    const float neck = height - 1.5F * radius, slab = 0.55F * radius, thin = taper * radius;
    Shape shape = plinth(2.7F * radius, foot);
    Outline outline = atticBase(radius);
    for (glm::vec2& point : outline)
        point.y += foot;
    for (int i = 1; i < 6; ++i)
        outline.push_back({shaftRadius(radius, part(i, 6)), glm::mix(base, neck, part(i, 6))});
    outline.push_back({thin, neck - 0.1F * radius});
    addArc(outline, {thin, neck}, 0.1F * radius, -90, 90, 5);
    outline.push_back({thin, neck + 0.45F * radius});
    addArc(outline, {thin + 0.1F * radius, height - slab - 0.05F * radius}, 0.42F * radius, -60, 0,
           5);
    outline.push_back({thin + 0.52F * radius, height - slab});
    shape.add(lathe(outline, 16));
    shape.add(abacus(2.9F * radius, slab), at({0, height - slab, 0}));
    return shape;
}

Shape pier(glm::vec2 size, float height) {
    const float unit = 0.1F;
    Outline outline{{0.06F, 0}, {0.06F, 1.4F * unit}};
    addArc(outline, {0.02F, 1.75F * unit}, 0.35F * unit, -90, 90, 5);
    outline.insert(outline.end(),
                   {{0.02F, 2.2F * unit}, {0, 2.4F * unit}, {0, height - 3.4F * unit}});
    addArc(outline, {0, height - 3.1F * unit}, 0.3F * unit, -90, 90, 4);
    outline.push_back({0, height - 2.2F * unit});
    addArc(outline, {0.6F * unit, height - 2.2F * unit}, 0.6F * unit, 180, 90, 5);
    outline.insert(outline.end(), {{0.8F * unit, height - 1.5F * unit},
                                   {0.8F * unit, height},
                                   {-std::min(size.x, size.y) / 2, height}});
    return pillar(outline, size);
}

Shape pedestal(float width, float height) {
    Outline outline{{0.03F, 0}, {0.03F, 0.09F}, {0.01F, 0.12F}, {0, 0.12F}, {0, height - 0.12F}};
    addArc(outline, {0.03F, height - 0.12F}, 0.03F, 180, 90, 3);
    outline.insert(outline.end(), {{0.045F, height - 0.07F},
                                   {0.045F, height - 0.01F},
                                   {0.035F, height},
                                   {-width / 2, height}});
    return pillar(outline, {width, width});
}

Shape baluster(float height) {
    const float h = height;
    Shape shape = plinth(0.18F * h, 0.08F * h);
    Outline outline{{0.085F * h, 0.08F * h}, {0.085F * h, 0.10F * h}, {0.055F * h, 0.13F * h}};
    addArc(outline, {0.02F * h, 0.34F * h}, 0.105F * h, -62, 50, 5); // the belly
    outline.insert(outline.end(), {{0.042F * h, 0.56F * h}, {0.035F * h, 0.70F * h}});
    addArc(outline, {0.04F * h, 0.74F * h}, 0.025F * h, -80, 80, 2);
    outline.insert(outline.end(), {{0.04F * h, 0.79F * h},
                                   {0.06F * h, 0.87F * h},
                                   {0.085F * h, 0.90F * h},
                                   {0.085F * h, 0.92F * h}});
    shape.add(lathe(outline, 8));
    shape.add(plinth(0.18F * h, 0.08F * h), at({0, 0.92F * h, 0}));
    return shape;
}

} // namespace obscura::builtin
