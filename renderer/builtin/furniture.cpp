#include "renderer/builtin/furniture.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>

namespace obscura::builtin {

namespace {

// One piece of wood among others.
void addWood(Shape& shape, Shape piece, const glm::mat4& place) {
    alongGrain(piece);
    shape.add(piece, place);
}

// Thick in its lower middle, thin at the foot.
Shape turnedLeg(glm::vec3 top, glm::vec3 foot, float radius) {
    constexpr std::array<glm::vec2, 6> profile{glm::vec2(0, 0.75F), {0.12F, 0.95F}, {0.45F, 1.1F},
                                               {0.62F, 1.0F},       {0.85F, 0.72F}, {1, 0.55F}};
    std::vector<glm::vec4> path;
    for (const glm::vec2 point : profile)
        path.emplace_back(glm::mix(top, foot, point.x), radius * point.y);
    return tube(path, 10);
}

// The back of the chair: a bow over the seat, and a place on it at the height of its spindle.
glm::vec3 bowPoint(float t) { // 0 ... 1 from the left foot to the right one
    const float angle = glm::pi<float>() * t;
    const float x = -std::cos(angle), y = std::pow(std::sin(angle), 0.55F);
    return {0.21F * x * (1 - 0.06F * y), 0.45F + 0.45F * y, -0.17F - 0.13F * y};
}

void addBack(Shape& shape) {
    std::vector<glm::vec4> bow;
    for (int i = 0; i <= 28; ++i)
        bow.emplace_back(bowPoint(part(i, 28)), 0.011F);
    shape.add(tube(bow, 8));
    const int spindles = 7;
    for (int i = 1; i <= spindles; ++i) {
        const float t = 0.5F - 0.5F * std::cos(glm::pi<float>() * part(i, spindles + 1));
        const float x = 0.205F * (2 * part(i, spindles + 1) - 1);
        const glm::vec3 top = bowPoint(0.12F + 0.76F * (0.55F * part(i, spindles + 1) + 0.45F * t));
        const glm::vec3 foot(0.9F * x, 0.44F, -0.175F + 0.9F * x * x * 0.4F);
        const glm::vec3 middle = glm::mix(foot, top, 0.4F) + glm::vec3(0, 0, 0.012F);
        shape.add(tube(
            std::array{glm::vec4(foot, 0.006F), glm::vec4(middle, 0.0085F), glm::vec4(top, 0.005F)},
            6));
    }
}

} // namespace

Shape windsorChair() {
    Shape seat = rounded({0.44F, 0.036F, 0.43F}, 0.016F, 4, 2);
    deform(seat, [](glm::vec3 p) { // narrower behind, hollowed for who sits
        const float x = p.x / 0.22F, z = p.z / 0.215F;
        const float hollow =
            p.y > 0 ? 0.012F * std::max(0.0F, 1 - x * x) * std::max(0.0F, 1 - z * z) : 0.0F;
        return glm::vec3(p.x * (1 + 0.06F * z - 0.05F * z * z), p.y - hollow,
                         p.z * (1 - 0.08F * x * x));
    });
    Shape shape;
    addWood(shape, seat, at({0, 0.432F, 0}));
    const auto leg = [](float x, float z) { // where a leg is at height y
        return [=](float y) {
            const float down = 1 - y / 0.42F;
            return glm::vec3(x * (0.72F + 0.28F * down), y, z * (0.74F + 0.26F * down));
        };
    };
    for (const float x : {-0.2F, 0.2F}) {
        for (const float z : {-0.21F, 0.2F})
            shape.add(turnedLeg(leg(x, z)(0.42F), leg(x, z)(0), 0.0165F));
        shape.add(
            rod(glm::vec4(leg(x, -0.21F)(0.17F), 0.009F), glm::vec4(leg(x, 0.2F)(0.17F), 0.009F)));
    }
    const glm::vec3 left = glm::mix(leg(-0.2F, -0.21F)(0.17F), leg(-0.2F, 0.2F)(0.17F), 0.5F);
    shape.add(rod(glm::vec4(left, 0.009F), glm::vec4(-left.x, left.y, left.z, 0.009F)));
    addBack(shape);
    return shape;
}

Shape table(glm::vec3 size) {
    const float top = 0.03F, inset = 0.07F;
    Shape shape;
    addWood(shape, rounded({size.x, top, size.z}, 0.008F), at({0, size.y - top / 2, 0}));
    const glm::vec2 legs(size.x / 2 - inset, size.z / 2 - inset);
    const float apron = 0.075F, under = size.y - top - apron / 2;
    for (const float side : {-1.0F, 1.0F}) {
        addWood(shape, box({2 * legs.x - 0.04F, apron, 0.02F}, 0.002F),
                at({0, under, side * legs.y}));
        addWood(shape, box({0.02F, apron, 2 * legs.y - 0.04F}, 0.002F),
                at({side * legs.x, under, 0}));
        for (const float end : {-1.0F, 1.0F}) {
            const glm::vec3 foot(side * legs.x, 0, end * legs.y);
            const float height = size.y - top;
            shape.add(
                tube(std::array{glm::vec4(foot, 0.014F),
                                glm::vec4(foot + glm::vec3(0, height - 1.2F * apron, 0), 0.026F),
                                glm::vec4(foot + glm::vec3(0, height, 0), 0.027F)},
                     14));
        }
    }
    return shape;
}

Shape tripodTable(float radius, float height) {
    Outline top{{0, -0.022F}, {radius - 0.012F, -0.022F}};
    addArc(top, {radius - 0.011F, -0.011F}, 0.011F, -80, 80, 5);
    top.insert(top.end(), {{radius - 0.012F, 0}, {0, 0}});
    Shape shape;
    addWood(shape, lathe(top, 48), at({0, height, 0}));
    for (int i = 0; i < 3; ++i) {
        const float angle = glm::two_pi<float>() * (part(i, 3) + 0.08F);
        const glm::vec3 out(std::sin(angle), 0, std::cos(angle));
        const glm::vec3 head = 0.45F * radius * out + glm::vec3(0, height - 0.02F, 0);
        shape.add(rod(glm::vec4(0.85F * radius * out, 0.010F), glm::vec4(head, 0.017F), 10));
    }
    return shape;
}

Shape stool(float height) {
    Shape shape = tripodTable(0.17F, height);
    const float y = 0.35F * height;
    for (int i = 0; i < 3; ++i) {
        const auto place = [&](int k) {
            const float angle = glm::two_pi<float>() * (part(k, 3) + 0.08F);
            return glm::vec4(0.121F * std::sin(angle), y, 0.121F * std::cos(angle), 0.007F);
        };
        shape.add(rod(place(i), place(i + 1)));
    }
    return shape;
}

namespace {

// A cushion full in its middle.
Shape stuffed(glm::vec3 size, float radius, float fullness) {
    Shape shape = rounded(size, radius, 7);
    const glm::vec3 half = size / 2.0F;
    deform(shape, [=](glm::vec3 p) {
        const glm::vec3 q = glm::min(glm::abs(p / half), 1.0F);
        const glm::vec3 free = 1.0F - q * q * q * q;
        const float swell = 1 + fullness * free.x * free.z;
        return glm::vec3(p.x * (1 + 0.015F * free.z * free.y), p.y * swell,
                         p.z * (1 + 0.03F * free.x * free.y));
    });
    return shape;
}

} // namespace

Upholstered sofa(float width, int seats) {
    const float arm = 0.17F, inside = width - 2 * arm, each = inside / part(seats, 1);
    Upholstered result;
    Shape& cloth = result.cloth;
    cloth.add(rounded({width - 0.02F, 0.19F, 0.84F}, 0.025F), at({0, 0.235F, 0}));
    for (const float side : {-1.0F, 1.0F})
        cloth.add(stuffed({arm, 0.46F, 0.88F}, 0.06F, 0.02F),
                  at({side * (width - arm) / 2, 0.37F, 0}));
    cloth.add(rounded({inside + 0.04F, 0.50F, 0.16F}, 0.06F), pitched(at({0, 0.55F, -0.35F}), -6));
    for (int i = 0; i < seats; ++i) {
        const float x = each * (part(i, 1) + 0.5F) - inside / 2;
        cloth.add(stuffed({each - 0.006F, 0.15F, 0.66F}, 0.05F, 0.16F), at({x, 0.395F, 0.10F}));
        cloth.add(stuffed({each - 0.02F, 0.16F, 0.42F}, 0.06F, 0.35F),
                  pitched(at({x, 0.66F, -0.19F}), -104));
    }
    for (const float x : {-1.0F, 1.0F})
        for (const float z : {-0.36F, 0.36F})
            result.legs.add(rod({x * (width / 2 - 0.04F), 0, 1.05F * z, 0.011F},
                                {x * (width / 2 - 0.08F), 0.145F, z, 0.02F}, 10));
    return result;
}

Shelves openShelves(float width, int bays, float depth, std::span<const float> heights) {
    const float bar = 0.018F, each = width / part(bays, 1);
    const float top = heights.back() + 0.06F;
    Shelves result;
    for (const float height : heights)
        addWood(result.boards, box({width + 0.04F, boardThickness, depth}, 0.003F),
                at({0, height - boardThickness / 2, 0}));
    for (int i = 0; i <= bays; ++i) {
        const float x = each * part(i, 1) - width / 2;
        for (const float z : {-1.0F, 1.0F})
            result.bars.add(box({bar, top, bar}, 0.002F),
                            at({x, top / 2, z * (depth / 2 + bar / 2 - 0.001F)}));
        for (const float height : heights)
            result.bars.add(box({bar * 0.8F, 0.01F, depth + bar}, 0.002F),
                            at({x, height - boardThickness - 0.004F, 0}));
    }
    // A cross behind each second bay keeps it from swaying.
    for (int i = 0; i < bays; i += 2)
        for (const float turn : {-1.0F, 1.0F}) {
            const float x = each * (part(i, 1) + 0.5F) - width / 2, z = -depth / 2 - 0.006F;
            result.bars.add(rod({x - turn * each / 2, heights.front(), z, 0.003F},
                                {x + turn * each / 2, heights.back(), z, 0.003F}, 6));
        }
    return result;
}

Shelves sideboard(glm::vec3 size) {
    const float legs = 0.22F, height = size.y - legs, board = 0.02F;
    Shelves result;
    Shape& boards = result.boards;
    for (const float y : {legs + board / 2, size.y - board / 2})
        addWood(boards, box({size.x, board, size.z}, 0.004F), at({0, y, 0}));
    for (const float side : {-1.0F, 1.0F})
        addWood(boards, box({board, height - 2 * board, size.z - 0.006F}, 0.002F),
                at({side * (size.x - board) / 2, legs + height / 2, 0}));
    addWood(boards, box({size.x - 0.01F, height - 0.01F, 0.01F}, 0.001F),
            at({0, legs + height / 2, 0.01F - size.z / 2}));
    const float inside = size.x - 2 * board, third = inside / 3;
    for (int i = 0; i < 3; ++i) {
        const float x = third * (part(i, 1) - 1);
        if (i == 1) { // open, with one shelf
            addWood(boards, box({third - 0.02F, 0.016F, size.z - 0.03F}, 0.002F),
                    at({x, legs + height / 2, 0}));
            for (const float side : {-0.5F, 0.5F})
                addWood(boards, box({0.016F, height - 2 * board, size.z - 0.02F}, 0.002F),
                        at({x + side * third, legs + height / 2, 0}));
            continue;
        }
        addWood(boards, box({third - 0.014F, height - 2 * board - 0.006F, 0.018F}, 0.003F),
                at({x, legs + height / 2, size.z / 2 - 0.014F}));
        const float knob = x - (x > 0 ? 1.0F : -1.0F) * (third / 2 - 0.05F);
        result.bars.add(rod({knob, legs + height / 2, size.z / 2 - 0.01F, 0.006F},
                            {knob, legs + height / 2, size.z / 2 + 0.02F, 0.011F}, 12));
    }
    for (const float x : {-1.0F, 1.0F})
        for (const float z : {-1.0F, 1.0F})
            boards.add(rod(
                {x * (size.x / 2 - 0.05F), 0, z * (size.z / 2 - 0.03F), 0.009F},
                {x * (size.x / 2 - 0.10F), legs + 0.002F, z * (size.z / 2 - 0.07F), 0.016F}, 10));
    return result;
}

namespace {

// Thin cloth round a frame, open above and below; y = 0 is its lower rim.
Shape shadeShape(float low, float high, float height) {
    const float thin = 0.002F;
    return lathe(
        {{low - thin, 0}, {low, 0}, {high, height}, {high - thin, height}, {low - thin, 0}}, 40);
}

// Three wires that hold a shade, and the bulb.
void addFitting(Lamp& lamp, float radius, float y) {
    for (int i = 0; i < 3; ++i) {
        const float angle = glm::two_pi<float>() * part(i, 3);
        lamp.stand.add(rod({0, y - 0.04F, 0, 0.002F},
                           {radius * std::sin(angle), y, radius * std::cos(angle), 0.002F}, 6));
    }
    lamp.stand.add(rod({0, y - 0.1F, 0, 0.016F}, {0, y - 0.02F, 0, 0.016F}, 12));
}

Shape bulb() {
    Outline outline{{0, -0.12F}};
    addArc(outline, {0, -0.07F}, 0.034F, -80, 40, 8);
    outline.insert(outline.end(), {{0.014F, -0.02F}, {0.013F, 0}, {0, 0}});
    return lathe(outline, 14);
}

} // namespace

Lamp floorLamp(float height) {
    Lamp lamp;
    const float shade = 0.26F;
    lamp.shade.add(shadeShape(0.24F, 0.18F, shade), at({0, height - shade, 0}));
    lamp.shade.add(bulb(), glm::scale(at({0, height - 0.1F, 0}), {1, -1, 1}));
    addFitting(lamp, 0.178F, height - 0.004F);
    const glm::vec3 hub(0, height - shade - 0.12F, 0);
    for (int i = 0; i < 3; ++i) {
        const float angle = glm::two_pi<float>() * part(i, 3);
        const glm::vec3 out(std::sin(angle), 0, std::cos(angle));
        lamp.stand.add(rod(glm::vec4(0.27F * out, 0.009F),
                           glm::vec4(hub - 0.012F * out + glm::vec3(0, 0.03F, 0), 0.013F), 10));
    }
    lamp.stand.add(rod(glm::vec4(hub + glm::vec3(0, -0.05F, 0), 0.02F),
                       glm::vec4(hub + glm::vec3(0, 0.05F, 0), 0.02F), 14));
    lamp.stand.add(rod(glm::vec4(hub, 0.008F), {0, height - 0.1F, 0, 0.008F}));
    return lamp;
}

Lamp pendant(float radius, float drop) {
    Lamp lamp;
    Outline outline;
    addArc(outline, {0, -radius}, radius, 0, 84, 12);
    for (glm::vec2& point : outline)
        point.y = 0.75F * (point.y + radius);
    const std::size_t outside = outline.size();
    for (std::size_t i = outside; i-- > 0;)
        outline.push_back(outline[i] * glm::vec2(0.985F, 0.97F));
    outline.push_back(outline.front());
    lamp.shade.add(lathe(outline, 40), at({0, -drop, 0}));
    lamp.shade.add(bulb(), at({0, 0.72F * radius - drop, 0}));
    lamp.stand.add(
        rod({0, 0.68F * radius - drop, 0, 0.022F}, {0, 0.85F * radius - drop, 0, 0.016F}, 14));
    lamp.stand.add(rod({0, 0.8F * radius - drop, 0, 0.003F}, {0, 0, 0, 0.003F}, 6));
    lamp.stand.add(lathe({{0, -0.03F}, {0.04F, -0.03F}, {0.05F, -0.02F}, {0.05F, 0}}, 20));
    return lamp;
}

Lamp tableLamp(float height) {
    Lamp lamp;
    const float shade = 0.42F * height;
    lamp.shade.add(shadeShape(0.36F * height, 0.24F * height, shade), at({0, height - shade, 0}));
    addFitting(lamp, 0.238F * height, height - 0.004F);
    Outline foot{{0, 0}, {0.2F, 0}, {0.21F, 0.02F}, {0.14F, 0.06F}, {0.06F, 0.09F}};
    addArc(foot, {0.05F, 0.3F}, 0.13F, -70, 75, 10);
    foot.insert(foot.end(), {{0.03F, 0.48F}, {0.03F, 0.8F}, {0, 0.8F}});
    for (glm::vec2& point : foot)
        point *= height;
    lamp.stand.add(lathe(foot, 28));
    return lamp;
}

} // namespace obscura::builtin
