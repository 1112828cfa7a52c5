#include "renderer/builtin/joinery.h"

#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>

namespace obscura::builtin {

namespace {

// Four bars of a rectangular frame in the plane z = 0, its lower left corner at `low`.
void addFrame(Shape& shape, glm::vec2 low, glm::vec2 high, glm::vec2 bar, float bevel) {
    const glm::vec2 middle = (low + high) / 2.0F;
    for (const float x : {low.x + bar.x / 2, high.x - bar.x / 2})
        shape.add(box({bar.x, high.y - low.y, bar.y}, bevel), at({x, middle.y, 0}));
    for (const float y : {low.y + bar.x / 2, high.y - bar.x / 2})
        shape.add(box({high.x - low.x - 2 * bar.x, bar.x, 0.98F * bar.y}, bevel),
                  at({middle.x, y, 0}));
}

} // namespace

Shape casements(glm::vec2 size, int rows) {
    const float frame = 0.045F, sash = 0.05F, bar = 0.022F;
    Shape shape;
    addFrame(shape, {-size.x / 2, 0}, {size.x / 2, size.y}, {frame, 0.09F}, 0.004F);
    for (const float side : {-1.0F, 1.0F}) {
        const float inner = 0.002F, outside = size.x / 2 - frame - 0.002F;
        const glm::vec2 low(side < 0 ? -outside : inner, frame + 0.002F);
        const glm::vec2 high(side < 0 ? -inner : outside, size.y - frame - 0.002F);
        addFrame(shape, low, high, {sash, 0.055F}, 0.005F);
        const float middle = (low.x + high.x) / 2;
        for (int i = 1; i < rows; ++i)
            shape.add(box({high.x - low.x - 2 * sash, bar, 0.03F}, 0.004F),
                      at({middle, glm::mix(low.y + sash, high.y - sash, part(i, rows)), 0}));
        shape.add(box({bar, high.y - low.y - 2 * sash, 0.031F}, 0.004F),
                  at({middle, size.y / 2, 0}));
    }
    const float y = 0.45F * size.y; // the handle
    shape.add(rod({-0.028F, y, 0.02F, 0.008F}, {-0.028F, y, 0.055F, 0.008F}));
    shape.add(rod({-0.028F, y + 0.01F, 0.055F, 0.009F}, {-0.028F, y - 0.1F, 0.06F, 0.007F}));
    return shape;
}

Shape architrave(glm::vec2 size, bool below) {
    const float width = 0.075F, thick = 0.018F;
    Shape shape;
    const auto board = [&](glm::vec2 length, glm::vec2 middle) {
        shape.add(box({length, thick}, 0.004F), at({middle, thick / 2 - 0.002F}));
        const glm::vec2 rim = glm::min(length, glm::vec2(width)) / 3.0F;
        const glm::vec2 bead(length.x > width ? length.x - 0.002F : rim.x,
                             length.y > width ? length.y - 0.002F : rim.y);
        shape.add(box({bead, thick + 0.008F}, 0.004F), at({middle, thick / 2}));
    };
    const float low = below ? -width : 0.0F;
    for (const float side : {-1.0F, 1.0F})
        board({width, size.y - low + width},
              {side * (size.x + width) / 2, (size.y + low + width) / 2});
    board({size.x, width}, {0, size.y + width / 2});
    if (below)
        board({size.x, width}, {0, -width / 2});
    return shape;
}

Shape panelDoor(glm::vec2 size) {
    const float thick = 0.04F, rail = 0.11F;
    Shape shape;
    shape.add(box({size.x - 0.01F, size.y - 0.01F, 0.6F * thick}, 0.002F), at({0, size.y / 2, 0}));
    const std::array<float, 3> heights{0.0F, 0.42F * size.y, size.y};
    for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
        const glm::vec2 low(-size.x / 2, heights[i]), high(size.x / 2, heights[i + 1]);
        addFrame(shape, low + 0.003F, high - 0.003F, {rail, thick}, 0.006F);
        const glm::vec2 panel = high - low - 2 * rail - 0.07F;
        shape.add(box({panel, 0.9F * thick}, 0.009F), at({0, (low.y + high.y) / 2, 0}));
    }
    const glm::vec2 knob(size.x / 2 - 0.055F, 0.42F * size.y + 0.04F);
    shape.add(box({0.04F, 0.2F, 0.006F}, 0.002F), at({knob.x, knob.y, thick / 2 + 0.002F}));
    shape.add(tube(std::array{glm::vec4(knob, thick / 2, 0.009F),
                              glm::vec4(knob, thick / 2 + 0.04F, 0.009F),
                              glm::vec4(knob.x - 0.02F, knob.y, thick / 2 + 0.05F, 0.009F),
                              glm::vec4(knob.x - 0.12F, knob.y, thick / 2 + 0.05F, 0.008F)},
                   10));
    return shape;
}

Shape radiator(int columns, float height) {
    const float pitch = 0.058F, foot = 0.09F;
    Shape shape;
    for (int i = 0; i < columns; ++i) {
        const float x = pitch * (part(i, 1) - part(columns - 1, 2));
        for (const float z : {-0.05F, 0.0F, 0.05F})
            shape.add(rod({x, foot, z, 0.0135F}, {x, height, z, 0.0135F}, 8));
        for (const float y : {foot + 0.025F, height - 0.025F})
            shape.add(rounded({pitch - 0.002F, 0.052F, 0.135F}, 0.022F, 1, 1), at({x, y, 0}));
    }
    const float end = pitch * part(columns, 2);
    for (const float side : {-1.0F, 1.0F})
        for (const float z : {-0.05F, 0.05F})
            shape.add(rod({side * (end - pitch / 2), 0, z, 0.014F},
                          {side * (end - pitch / 2), foot + 0.02F, z, 0.014F}, 10));
    const float y = foot + 0.025F;
    shape.add(rod({end - 0.01F, y, 0, 0.012F}, {end + 0.06F, y, 0, 0.012F}, 10));
    shape.add(rod({end + 0.06F, 0, 0, 0.008F}, {end + 0.06F, y + 0.03F, 0, 0.008F}, 10));
    shape.add(rod({end + 0.06F, y + 0.02F, 0, 0.022F}, {end + 0.06F, y + 0.08F, 0, 0.018F}, 14));
    return shape;
}

Shape ironFence(float length, float height, float gap) {
    Shape shape;
    for (const float y : {0.12F, height - 0.14F})
        shape.add(box({length, 0.035F, 0.012F}, 0.002F), at({0, y, 0}));
    const int bars = static_cast<int>(std::lround(length / gap));
    for (int i = 0; i <= bars; ++i) {
        const float x = length * (part(i, bars) - 0.5F) * (1 - 0.016F / length);
        shape.add(tube(
            std::array{glm::vec4(x, 0.03F, 0, 0.008F), glm::vec4(x, height - 0.07F, 0, 0.008F),
                       glm::vec4(x, height - 0.055F, 0, 0.016F), glm::vec4(x, height, 0, 0.001F)},
            6));
    }
    return shape;
}

Shape trellis(glm::vec2 size) {
    const float lath = 0.024F, thin = 0.009F;
    Shape shape;
    const int across = static_cast<int>(std::lround(size.x / 0.16F)),
              up = static_cast<int>(std::lround(size.y / 0.16F));
    const auto add = [&](glm::vec3 piece, glm::vec3 place) {
        Shape wood = box(piece, 0.001F);
        alongGrain(wood);
        shape.add(wood, at(place));
    };
    for (int i = 0; i <= across; ++i)
        add({lath, size.y, thin}, {size.x * (part(i, across) - 0.5F) * 0.98F, size.y / 2, 0.02F});
    for (int j = 0; j < up; ++j)
        add({size.x, lath, thin}, {0, size.y * (part(j, up) + 0.5F / part(up, 1)), 0.0285F});
    return shape;
}

Shape wateringCan() {
    Outline body{{0, 0},         {0.085F, 0},     {0.09F, 0.004F},
                 {0.09F, 0.20F}, {0.08F, 0.225F}, {0.055F, 0.235F}};
    body.insert(body.end(),
                {{0.052F, 0.232F}, {0.052F, 0.22F}, {0.084F, 0.2F}, {0.084F, 0.01F}, {0, 0.01F}});
    Shape shape = lathe(body, 28);
    shape.add(
        tube(std::array{glm::vec4(0.07F, 0.05F, 0, 0.022F), glm::vec4(0.16F, 0.13F, 0, 0.016F),
                        glm::vec4(0.27F, 0.26F, 0, 0.011F)},
             12));
    shape.add(rod({0.262F, 0.25F, 0, 0.012F}, {0.295F, 0.289F, 0, 0.034F}, 16)); // the rose
    const auto handle = [&](glm::vec2 from, glm::vec2 over, glm::vec2 to) {
        std::vector<glm::vec4> path;
        for (int i = 0; i <= 12; ++i) {
            const float t = part(i, 12);
            const glm::vec2 p = (1 - t) * (1 - t) * from + 2 * t * (1 - t) * over + t * t * to;
            path.emplace_back(p, 0, 0.006F);
        }
        shape.add(tube(path, 8));
    };
    handle({-0.088F, 0.06F}, {-0.26F, 0.30F}, {-0.05F, 0.236F});
    handle({-0.045F, 0.235F}, {0.0F, 0.38F}, {0.06F, 0.23F});
    return shape;
}

Bench gardenBench(float width) {
    Bench bench;
    const auto slat = [&](glm::vec3 place, float degrees, float across) {
        Shape board = box({width, across, 0.022F}, 0.005F);
        alongGrain(board);
        for (Vertex& vertex : board.vertices)
            vertex.uv.y += 3.7F * place.z;
        bench.wood.add(board, pitched(at(place), degrees));
    };
    // Of each slat z, y and tilt: the seat, hollow in its middle, and the back.
    for (const glm::vec3& each : {glm::vec3(0.2F, 0.445F, 82),
                                  {0.122F, 0.432F, 85},
                                  {0.044F, 0.426F, 88},
                                  {-0.034F, 0.426F, 92},
                                  {-0.112F, 0.432F, 95},
                                  {-0.19F, 0.445F, 98}})
        slat({0, each.y, each.x}, each.z, 0.066F);
    for (const glm::vec2& each : {glm::vec2(-0.225F, 0.54F),
                                  {-0.245F, 0.625F},
                                  {-0.265F, 0.71F},
                                  {-0.285F, 0.795F},
                                  {-0.305F, 0.88F}})
        slat({0, each.y, each.x}, -13, 0.07F);
    for (const float side : {-1.0F, 0.0F, 1.0F}) {
        const float x = side * (width / 2 - 0.12F);
        const auto iron = [&](std::initializer_list<glm::vec2> points, float radius) {
            std::vector<glm::vec4> path;
            for (const glm::vec2 p : points) // (z, y)
                path.emplace_back(x, p.y, p.x, radius);
            bench.iron.add(tube(path, 8));
        };
        iron({{0.27F, 0.0F},
              {0.225F, 0.1F},
              {0.2F, 0.25F},
              {0.215F, 0.36F},
              {0.2F, 0.415F},
              {0.1F, 0.405F},
              {0.0F, 0.398F},
              {-0.1F, 0.405F},
              {-0.2F, 0.42F},
              {-0.235F, 0.5F},
              {-0.27F, 0.68F},
              {-0.325F, 0.93F},
              {-0.345F, 0.95F}},
             0.014F);
        iron({{-0.32F, 0.0F}, {-0.26F, 0.12F}, {-0.22F, 0.27F}, {-0.21F, 0.42F}}, 0.014F);
        iron({{0.21F, 0.22F}, {0.08F, 0.28F}, {-0.08F, 0.28F}, {-0.225F, 0.22F}}, 0.009F);
        if (side != 0)
            iron({{0.205F, 0.40F},
                  {0.24F, 0.52F},
                  {0.215F, 0.62F},
                  {0.1F, 0.65F},
                  {-0.1F, 0.645F},
                  {-0.275F, 0.66F}},
                 0.012F);
    }
    return bench;
}

} // namespace obscura::builtin
