#include "renderer/builtin/furnishings.h"
#include "renderer/builtin/garden.h"
#include "renderer/builtin/joinery.h"
#include "renderer/builtin/masonry.h"
#include "renderer/builtin/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace obscura::builtin::garden_plan {

namespace {

Shape flat(glm::vec2 low, glm::vec2 high, float y, int cells) {
    Shape shape = patch(
        [=](glm::vec2 uv) {
            const glm::vec2 p = glm::mix(low, high, glm::vec2(uv.x, 1 - uv.y));
            return glm::vec3(p.x, y, p.y);
        },
        cells, cells, {1, 1});
    projectUv(shape);
    return shape;
}

// A stone of this size that is not quite a box.
Shape stone(glm::vec3 size, Random& random) {
    const Noise noise("builtin/stone");
    Shape shape = rounded(size, 0.2F * std::min({size.x, size.y, size.z}), 1, 1);
    const float other = between(random, 0, 200);
    deform(shape, [&](glm::vec3 p) {
        return p * (1 + 0.06F * noise.value(p * 7.0F + other)) +
               0.012F * noise.value(p * 11.0F + other + 50.0F);
    });
    projectUv(shape);
    for (Vertex& vertex : shape.vertices)
        vertex.uv += other;
    const float tone = between(random, 0.62, 0.95), warm = between(random, -0.05, 0.05);
    return tinted(shape, {tone + warm, tone, tone - warm});
}

// Courses of stones along x, from `from` to `to`, and a coping of flat ones.
void addDryWall(Shape& shape, const glm::mat4& place, float from, float to, float height,
                float thick, Random& random) {
    const int courses = static_cast<int>(std::lround((height - 0.06F) / 0.11F));
    const float course = (height - 0.06F) / part(courses, 1);
    for (int row = 0; row <= courses; ++row) {
        const bool coping = row == courses;
        float x = from;
        while (x < to - 0.02F) {
            float length = coping ? between(random, 0.35, 0.55) : between(random, 0.16, 0.36);
            if (to - x - length < 0.14F)
                length = to - x;
            const float tall = coping ? 0.065F : course * between(random, 0.98, 1.05);
            const float deep = thick + (coping ? 0.05F : between(random, -0.025, 0.01));
            const float y = course * part(row, 1) + tall / 2 - 0.006F;
            shape.add(stone({length - 0.008F, tall, deep}, random),
                      place * at({x + length / 2, y, 0}));
            x += length;
        }
    }
    // No light falls through its joints.
    const glm::vec3 core(to - from - 0.06F, height - 0.03F, thick - 0.1F);
    shape.add(tinted(box(core, 0), glm::vec3(0.4F)), place * at({(from + to) / 2, core.y / 2, 0}));
}

} // namespace

void addGround(Works& works) {
    works.turf = flat({-half.x, bed}, {half.x, terrace}, 0, 24);
    works.earth = flat({-half.x, -half.y}, {half.x, bed}, bedHeight - 0.06F, 12);
    works.earth.add(flat({-half.x - 1.2F, -half.y}, {-half.x, half.y}, -0.005F, 4));
    works.earth.add(flat({-half.x, terrace}, {half.x, half.y}, -0.02F, 8));
    works.earth.add(flat({half.x, -half.y}, {lane + 1, half.y + 4}, -0.01F, 8));
    projectUv(works.earth);
    Random random(0, "builtin/garden/paving");
    // The terrace: slabs in rows, none quite level.
    const int rows = 4;
    const float row = (half.y - terrace) / part(rows, 1);
    for (int j = 0; j < rows; ++j)
        for (float x = -half.x; x < half.x - 0.01F;) {
            float length = between(random, 0.45, 0.85);
            if (half.x - x - length < 0.4F)
                length = half.x - x;
            Shape slab = box({length - 0.009F, 0.05F, row - 0.009F}, 0.006F);
            const float tilt = between(random, -0.25, 0.25), level = between(random, -0.003, 0.003);
            const glm::mat4 place =
                at({x + length / 2, level, terrace + row * (part(j, 1) + 0.5F)});
            Shape placed;
            placed.add(slab, rolled(place, tilt));
            projectUv(placed);
            for (Vertex& vertex : placed.vertices)
                vertex.uv += 3.1F * length;
            const float tone = between(random, 0.6, 0.82), warm = between(random, -0.03, 0.04);
            works.slabs.add(tinted(placed, {tone + warm, tone, tone - warm}));
            x += length;
        }
    // Stepping stones, and no two alike.
    for (const glm::vec2 step : steps) {
        Outline rim{{0, -0.03F}, {0.24F, -0.03F}};
        addArc(rim, {0.24F, 0.0F}, 0.02F, -30, 80, 3);
        rim.emplace_back(0.2F, 0.022F);
        rim.emplace_back(0, 0.024F);
        Shape round = lathe(rim, 20);
        const Noise noise("builtin/steps");
        deform(round, [&](glm::vec3 p) {
            const float s = 1 + 0.5F * noise.value(glm::vec3(3.2F * p.x, step.x * 7, 3.2F * p.z));
            return glm::vec3(p.x * s * 1.15F, p.y, p.z * s);
        });
        Shape placed;
        placed.add(round, at({step.x, 0, step.y}, between(random, 0, 360)));
        projectUv(placed);
        works.slabs.add(tinted(placed, glm::vec3(0.62F, 0.61F, 0.58F)));
    }
}

void addWalls(Works& works) {
    const float height = 2.1F, length = lane + 1 + half.x + 0.6F;
    const float middle = (lane + 1 - half.x - 0.6F) / 2;
    works.brick.add(box({length, height + 0.2F, 0.22F}, 0.004F),
                    at({middle, height / 2 - 0.1F, -half.y - 0.11F}));
    for (float x = -4.4F; x < half.x; x += 2.4F) // piers
        works.brick.add(box({0.34F, height + 0.1F, 0.12F}, 0.004F),
                        at({x, height / 2 - 0.05F, -half.y + 0.05F}));
    projectUv(works.brick);
    Random random(0, "builtin/garden/walls");
    for (float x = -half.x - 0.6F; x < lane + 0.9F; x += 0.6F)
        works.stone.add(stone({0.594F, 0.06F, 0.34F}, random),
                        at({x + 0.3F, height + 0.025F, -half.y - 0.11F}));
    addDryWall(works.stone, at({0, 0, bed}), -half.x, half.x, bedHeight + 0.06F, 0.2F, random);
    // East: low walls on both sides of the gate, each with a fence on it.
    const glm::mat4 along = at({half.x, 0, 0}, -90); // x runs south
    const float open = 0.55F, low = 0.5F;
    for (const auto& [from, to] :
         {std::pair(bed + 0.1F, gate - open - 0.18F), {gate + open + 0.18F, half.y}}) {
        addDryWall(works.stone, along, from, to, low, 0.24F, random);
        works.iron.add(ironFence(to - from, 0.75F, 0.115F), along * at({(from + to) / 2, low, 0}));
    }
    for (const float side : {-1.0F, 1.0F}) {
        const glm::mat4 place = at({half.x, -0.05F, gate + side * (open + 0.18F)});
        works.brick.add(box({0.36F, 1.6F, 0.36F}, 0.005F), place * at({0, 0.8F, 0}));
        works.stone.add(box({0.44F, 0.07F, 0.44F}, 0.015F), place * at({0, 1.63F, 0}));
        works.stone.add(lathe({{0, -0.12F},
                               {0.07F, -0.12F},
                               {0.05F, -0.09F},
                               {0.10F, -0.03F},
                               {0.115F, 0.03F},
                               {0.10F, 0.08F},
                               {0.05F, 0.12F},
                               {0, 0.13F}},
                              24),
                        place * at({0, 1.77F, 0}));
    }
    // The gate stands a little open.
    const float wide = 2 * open - 0.03F;
    const glm::mat4 hinge = at({half.x, 0, gate + open - 0.02F}) * at({0, 0, 0}, 90 + 28);
    works.iron.add(ironFence(wide, 1.25F, 0.1F), hinge * at({wide / 2, 0.02F, 0}));
    for (const float x : {0.012F, wide - 0.012F})
        works.iron.add(box({0.024F, 1.2F, 0.024F}, 0.003F), hinge * at({x, 0.64F, 0}));
    works.iron.add(rod({0.03F, 0.2F, 0, 0.006F}, {wide - 0.03F, 1.08F, 0, 0.006F}), hinge);
}

// The house's garden side, with a door and two windows.
void addHouse(Works& works) {
    const std::array<Hole, 3> holes{Hole{{-0.55F, 0.12F}, {0.55F, 2.2F}},
                                    {{-3.4F, 0.9F}, {-2.1F, 2.2F}},
                                    {{2.1F, 0.9F}, {3.4F, 2.2F}}};
    const glm::mat4 place = at({0, 0, half.y}, 180);
    works.house.add(piercedWall({2 * half.x + 1, 3.6F, 0.4F}, holes),
                    place * at({0, -0.1F, -0.2F}));
    projectUv(works.house);
    // Behind the panes it is dark.
    works.glass.add(box({2 * half.x + 0.9F, 3.3F, 0.1F}, 0), place * at({0, 1.6F, -0.25F}));
    // The eaves: a board, a gutter and its pipe, and the roof.
    works.paint.add(box({2 * half.x + 1.4F, 0.2F, 0.03F}, 0.005F), place * at({0, 3.46F, 0.30F}));
    works.paint.add(box({2 * half.x + 1.4F, 0.025F, 0.34F}, 0.003F), place * at({0, 3.38F, 0.14F}));
    Outline gutter;
    addArc(gutter, {0, 0}, 0.06F, 180, 360, 8);
    addArc(gutter, {0, 0}, 0.054F, 360, 180, 8);
    gutter.push_back(gutter.front());
    const std::array<glm::vec3, 2> eaves{glm::vec3(half.x + 0.7F, 3.52F, half.y - 0.375F),
                                         glm::vec3(-half.x - 0.7F, 3.52F, half.y - 0.375F)};
    works.iron.add(arch(gutter, eaves, {0, 3.52F, half.y}));
    works.iron.add(tube(std::array{glm::vec4(4.6F, 3.47F, half.y - 0.375F, 0.032F),
                                   glm::vec4(4.6F, 3.36F, half.y - 0.36F, 0.032F),
                                   glm::vec4(4.6F, 3.2F, half.y - 0.07F, 0.032F),
                                   glm::vec4(4.6F, 3.08F, half.y - 0.05F, 0.032F),
                                   glm::vec4(4.6F, 0.02F, half.y - 0.05F, 0.032F)},
                        12));
    Shape roof;
    for (int i = 0; i < 9; ++i) // courses of tiles
        roof.add(
            box({2 * half.x + 1.5F, 0.025F, 0.34F}, 0.006F),
            pitched(place * at({0, 3.58F + 0.175F * part(i, 1), 0.27F - 0.25F * part(i, 1)}), 29));
    projectUv(roof);
    works.terracotta.add(roof);
    for (const Hole& hole : holes) {
        const glm::vec2 size = hole.high - hole.low;
        const glm::mat4 corner = place * at({(hole.low.x + hole.high.x) / 2, hole.low.y - 0.1F, 0});
        const bool door = hole.low.y < 0.5F;
        works.paint.add(door ? panelDoor(size) : casements(size, 3), corner * at({0, 0, -0.12F}));
        works.paint.add(architrave(size, false), corner);
        if (!door)
            works.stone.add(box({size.x + 0.3F, 0.07F, 0.24F}, 0.012F),
                            corner * at({0, -0.035F, 0.02F}));
    }
    works.stone.add(box({1.5F, 0.12F, 0.5F}, 0.015F), place * at({0, -0.01F, 0.22F}));
}

} // namespace obscura::builtin::garden_plan
