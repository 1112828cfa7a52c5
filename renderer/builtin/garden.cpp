#include "renderer/builtin/clutter.h"
#include "renderer/builtin/furnishings.h"
#include "renderer/builtin/furniture.h"
#include "renderer/builtin/joinery.h"
#include "renderer/builtin/masonry.h"
#include "renderer/builtin/noise.h"
#include "renderer/builtin/plants.h"
#include "renderer/builtin/scenes.h"
#include "renderer/builtin/textures.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

// A small garden behind a house: leaves that are cut out, blades of grass, thin bars. No technique's
// settings were tuned on it.
namespace obscura::builtin {

namespace {

// The plan, in metres: x from west to east, z from north to south. To the north a brick wall, to the
// west a hedge, to the east a low wall with a fence and beyond it a lane and another hedge, to the
// south the house.
constexpr glm::vec2 half{5, 4};
constexpr float terrace = 2.1F;   // z where it begins
constexpr float bed = -2.75F;     // z where the raised bed ends
constexpr float bedHeight = 0.38F;
constexpr float lane = 8.2F;      // x where it ends
constexpr float gate = 0.9F;      // z of its middle

// One shape for each material.
struct Works {
    Shape brick, stone, slabs, house, paint, earth, turf, grass, bark, leaves, box, boxCore, roses, ivy,
        lavender, reed, iron, teak,
        terracotta, zinc, glass;
};

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
void addDryWall(Shape& shape, const glm::mat4& place, float from, float to, float height, float thick,
                Random& random) {
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
            shape.add(stone({length - 0.008F, tall, deep}, random), place * at({x + length / 2, y, 0}));
            x += length;
        }
    }
}

void addGround(Works& works) {
    works.turf = flat({-half.x, bed}, {half.x, terrace}, 0, 24);
    works.earth = flat({-half.x, -half.y}, {half.x, bed}, bedHeight - 0.06F, 12);
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
            const glm::mat4 place = at({x + length / 2, level, terrace + row * (part(j, 1) + 0.5F)});
            Shape placed;
            placed.add(slab, glm::rotate(place, glm::radians(tilt), glm::vec3(0, 0, 1)));
            projectUv(placed);
            for (Vertex& vertex : placed.vertices)
                vertex.uv += 3.1F * length;
            const float tone = between(random, 0.55, 0.8), warm = between(random, -0.03, 0.05);
            works.slabs.add(tinted(placed, {tone + warm, tone, tone - warm}));
            x += length;
        }
    // Stepping stones from the terrace to the gate, and setts in the lane.
    const std::array<glm::vec2, 6> steps{glm::vec2(0.7F, 1.72F), {1.35F, 1.4F}, {2.05F, 1.15F},
                                         {2.75F, 1.0F}, {3.5F, 0.92F}, {4.25F, 0.9F}};
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
        works.brick.add(box({0.34F, height + 0.1F, 0.12F}, 0.004F), at({x, height / 2 - 0.05F, -half.y + 0.05F}));
    projectUv(works.brick);
    Random random(0, "builtin/garden/walls");
    for (float x = -half.x - 0.6F; x < lane + 0.9F; x += 0.6F)
        works.stone.add(stone({0.594F, 0.06F, 0.34F}, random), at({x + 0.3F, height + 0.025F, -half.y - 0.11F}));
    addDryWall(works.stone, at({0, 0, bed}), -half.x, half.x, bedHeight + 0.06F, 0.2F, random);
    // East: low walls on both sides of the gate, each with a fence on it.
    const glm::mat4 along = at({half.x, 0, 0}, -90); // x runs south
    const float open = 0.55F, low = 0.5F;
    for (const auto& [from, to] : {std::pair(bed + 0.1F, gate - open - 0.18F), {gate + open + 0.18F, half.y}}) {
        addDryWall(works.stone, along, from, to, low, 0.24F, random);
        works.iron.add(ironFence(to - from, 0.75F, 0.115F), along * at({(from + to) / 2, low, 0}));
    }
    for (const float side : {-1.0F, 1.0F}) {
        const glm::mat4 place = at({half.x, -0.05F, gate + side * (open + 0.18F)});
        works.brick.add(box({0.36F, 1.6F, 0.36F}, 0.005F), place * at({0, 0.8F, 0}));
        works.stone.add(box({0.44F, 0.07F, 0.44F}, 0.015F), place * at({0, 1.63F, 0}));
        works.stone.add(lathe({{0, -0.12F}, {0.07F, -0.12F}, {0.05F, -0.09F}, {0.10F, -0.03F}, {0.115F, 0.03F},
                               {0.10F, 0.08F}, {0.05F, 0.12F}, {0, 0.13F}}, 24),
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
    const std::array<Hole, 3> holes{Hole{{-0.55F, 0.12F}, {0.55F, 2.2F}}, {{-3.4F, 0.9F}, {-2.1F, 2.2F}},
                                    {{2.1F, 0.9F}, {3.4F, 2.2F}}};
    const glm::mat4 place = at({0, 0, half.y}, 180);
    works.house.add(piercedWall({2 * half.x + 1, 3.6F, 0.4F}, holes), place * at({0, -0.1F, -0.2F}));
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
    Shape roof = box({2 * half.x + 1.5F, 0.08F, 2.6F}, 0.01F);
    Shape tilted;
    tilted.add(roof, glm::rotate(place * at({0, 4.25F, -0.75F}), glm::radians(33.0F), glm::vec3(1, 0, 0)));
    projectUv(tilted);
    works.brick.add(tilted);
    for (const Hole& hole : holes) {
        const glm::vec2 size = hole.high - hole.low;
        const glm::mat4 corner = place * at({(hole.low.x + hole.high.x) / 2, hole.low.y - 0.1F, 0});
        const bool door = hole.low.y < 0.5F;
        works.paint.add(door ? panelDoor(size) : casements(size, 3), corner * at({0, 0, -0.12F}));
        works.paint.add(architrave(size, false), corner);
        if (!door)
            works.stone.add(box({size.x + 0.3F, 0.07F, 0.24F}, 0.012F), corner * at({0, -0.035F, 0.02F}));
    }
    works.stone.add(box({1.5F, 0.12F, 0.5F}, 0.015F), place * at({0, -0.01F, 0.22F}));
}

void addPlanting(Works& works) {
    Random random(0, "builtin/garden/planting");
    const Tree apple = tree(4.4F, random);
    works.bark.add(apple.wood, at({-2.7F, 0, -0.9F}));
    works.leaves.add(apple.leaves, at({-2.7F, 0, -0.9F}));
    const Hedge west = hedge({2 * half.y - 0.1F, 1.75F, 0.75F}, 260, random);
    const glm::mat4 westPlace = at({-half.x - 0.3F, 0, 0}, 90);
    works.boxCore.add(west.core, westPlace);
    works.box.add(west.leaves, westPlace);
    const Hedge across = hedge({2 * half.y + 6, 2.2F, 0.9F}, 150, random);
    works.boxCore.add(across.core, at({lane + 0.4F, 0, 2.6F}, -90));
    works.box.add(across.leaves, at({lane + 0.4F, 0, 2.6F}, -90));

    struct Planted {
        float x, z, radius, height;
    };
    for (const Planted& each : {Planted{-1.0F, -3.45F, 0.5F, 1.15F}, {0.55F, -3.35F, 0.45F, 0.9F},
                                {3.6F, -3.4F, 0.55F, 1.3F}, {4.5F, -3.2F, 0.35F, 0.8F}}) {
        const Tree bush = shrub(each.radius, each.height, 0.15F, random);
        const glm::mat4 place = at({each.x, bedHeight - 0.06F, each.z});
        works.bark.add(bush.wood, place);
        works.roses.add(bush.leaves, place);
    }
    for (int i = 0; i < 9; ++i) {
        const float x = -4.6F + 1.05F * part(i, 1) + between(random, -0.15, 0.15);
        const float z = bed - 0.32F - between(random, 0, 0.2);
        works.lavender.add(tuft(34, 0.42F, 0.5F, random), at({x, bedHeight - 0.06F, z}));
    }
    for (const glm::vec2 p : {glm::vec2(1.9F, -3.3F), {-3.6F, -3.4F}, {4.45F, 2.0F}, {4.55F, -1.6F}})
        works.reed.add(tuft(46, 0.95F, 0.55F, random),
                       at({p.x, p.y < bed ? bedHeight - 0.06F : 0.0F, p.y}));
    const Noise noise("builtin/garden/ivy");
    works.ivy.add(climber({-5, 0.3F}, {1.4F, 2.3F}, 330,
                          [&](glm::vec2 p) {
                              const float top = 2.25F - 0.28F * std::abs(p.x + 3.4F);
                              return std::min(1.0F, top - p.y) + 0.5F * noise.value(glm::vec3(2.2F * p, 1));
                          },
                          random),
                  at({0, 0, -half.y}));
}

float grassHeight(glm::vec2 p, const Noise& noise) {
    const float cloud = noise.value(glm::vec3(1.3F * p.x, 0, 1.3F * p.y));
    const float trunk = glm::length(p - glm::vec2(-2.7F, -0.9F));
    const float edge = std::min({p.y - bed - 0.12F, half.x - 0.14F - p.x, p.x + half.x - 0.1F});
    if (edge < 0 || trunk < 0.16F)
        return 0;
    // Longer where the mower does not go.
    return 0.05F + 0.015F * cloud + 0.07F * ramp(0.22F, 0.02F, edge) + 0.07F * ramp(0.6F, 0.2F, trunk);
}

void addGrass(Works& works) {
    Random random(0, "builtin/garden/grass");
    const Noise noise("builtin/garden/grass");
    const std::array<glm::vec2, 6> steps{glm::vec2(0.7F, 1.72F), {1.35F, 1.4F}, {2.05F, 1.15F},
                                         {2.75F, 1.0F}, {3.5F, 0.92F}, {4.25F, 0.9F}};
    works.grass = lawn({-half.x, bed}, {half.x, terrace - 0.02F}, 680,
                       [&](glm::vec2 p) {
                           for (const glm::vec2 step : steps)
                               if (glm::length(p - step) < 0.27F)
                                   return 0.0F;
                           return grassHeight(p, noise);
                       },
                       random);
}

void addThings(Works& works) {
    const Bench seat = gardenBench(1.5F);
    const glm::mat4 place = at({-0.35F, 0, -2.1F}, 4);
    works.teak.add(seat.wood, place);
    works.iron.add(seat.iron, place);
    Random random(0, "builtin/garden/things");
    const auto pot = [&](glm::vec2 p, float height) {
        works.terracotta.add(urn(height), at({p.x, 0.026F, p.y}));
        return at({p.x, 0.026F + 0.84F * height, p.y});
    };
    for (const float side : {-1.0F, 1.0F}) { // two balls beside the door
        const glm::mat4 top = pot({side * 1.05F, 3.6F}, 0.45F);
        const Hedge ball = topiary(0.27F, random);
        works.bark.add(rod({0, -0.02F, 0, 0.018F}, {0, 0.3F, 0, 0.015F}), top);
        works.boxCore.add(ball.core, top * at({0, 0.42F, 0}));
        works.box.add(ball.leaves, top * at({0, 0.42F, 0}));
    }
    works.lavender.add(tuft(40, 0.4F, 0.6F, random), pot({-2.2F, 2.75F}, 0.34F));
    works.reed.add(tuft(36, 0.7F, 0.6F, random), pot({-3.1F, 3.3F}, 0.42F));
    const Tree bush = shrub(0.3F, 0.6F, 0.13F, random);
    const glm::mat4 top = pot({3.9F, 3.3F}, 0.4F);
    works.bark.add(bush.wood, top);
    works.roses.add(bush.leaves, top);
    // A table with two stools.
    works.iron.add(tripodTable(0.34F, 0.72F), at({2.3F, 0.026F, 2.95F}, 20));
    works.teak.add(stool(0.46F), at({1.65F, 0.026F, 2.75F}, 10));
    works.teak.add(stool(0.46F), at({2.75F, 0.026F, 3.45F}, 70));
    works.zinc.add(mug(), at({2.2F, 0.746F, 2.85F}, 40));
    works.zinc.add(bowl(0.11F, 0.06F), at({2.42F, 0.746F, 3.02F}));
    works.zinc.add(wateringCan(), at({0.72F, 0, -2.0F}, 150));
    works.teak.add(trellis({1.3F, 1.6F}), at({2.65F, bedHeight - 0.06F, 0.05F - half.y}));
    works.ivy.add(climber({2.0F, 0.35F}, {3.3F, 1.95F}, 240,
                          [](glm::vec2 p) {
                              const float stem = std::abs(p.x - 2.65F - 0.35F * std::sin(3.1F * p.y));
                              return 0.5F - 1.6F * stem + 0.12F * std::sin(9 * p.x + 5 * p.y) - 0.1F * p.y;
                          },
                          random),
                  at({0, 0, 0.085F - half.y}));
    // Leaves that have fallen.
    for (int i = 0; i < 130; ++i) {
        const float out = 1.9F * std::sqrt(between(random, 0, 1)), turn = between(random, 0, 6.28);
        const float way = between(random, 0, 6.28), up = between(random, -0.1, 0.25);
        const glm::vec3 foot(-2.7F + out * std::cos(turn), 0.045F, -0.7F + out * std::sin(turn));
        if (foot.z > bed + 0.2F)
            addCard(works.ivy, {foot, 0.06F * glm::normalize(glm::vec3(std::sin(way), up, std::cos(way))),
                                {0, 1, 0.2F}, 0.055F, 0.2F});
    }
}

void furnish(Scene& scene, const Works& works) {
    const auto add = [&](const Shape& shape, Material material, const Canvas& canvas,
                         const Painter& painter) {
        addMesh(scene, shape, addMaterial(scene, std::move(material), canvas, painter), canvas.metres);
    };
    const auto addLeaves = [&](const Shape& shape, const char* name, int size, const Painter& painter) {
        add(shape, {.name = name, .alphaCutoff = 0.5F, .doubleSided = true}, {size, 1, false}, painter);
    };
    add(works.brick, {.name = "bricks"}, {1024, 2}, bricks());
    add(works.stone, {.name = "stone"}, {512, 1.5F}, limestone());
    add(works.slabs, {.name = "slabs"}, {512, 1.5F}, limestone());
    add(works.house, {.name = "plaster"}, {512, 3}, plaster());
    add(works.paint, {.name = "paint", .roughness = 0.5F}, {256, 0.5F}, speckle({0.42F, 0.50F, 0.47F}, 0.1F));
    add(works.earth, {.name = "earth"}, {512, 2}, earth());
    add(works.turf, {.name = "turf"}, {512, 2}, turf());
    add(works.bark, {.name = "bark"}, {512, 1}, bark());
    add(works.boxCore, {.name = "inside"}, {256, 1, false}, turf());
    add(works.iron, {.name = "iron", .roughness = 0.6F}, {256, 0.5F}, speckle({0.14F, 0.15F, 0.15F}, 0.3F));
    add(works.teak, {.name = "teak"}, {512, 1}, grain({0.42F, 0.34F, 0.26F}, {0.62F, 0.54F, 0.43F}));
    add(works.terracotta, {.name = "terracotta"}, {512, 1}, glaze({0.70F, 0.42F, 0.29F}));
    add(works.zinc, {.name = "zinc", .roughness = 0.5F}, {256, 0.5F}, speckle({0.62F, 0.65F, 0.66F}, 0.2F));
    addLeaves(works.leaves, "apple", 512, twig(4, 0.30F, {0.14F, 0.25F, 0.07F}, {0.38F, 0.50F, 0.18F}));
    addLeaves(works.box, "box", 256, twig(4, 0.36F, {0.11F, 0.22F, 0.08F}, {0.30F, 0.43F, 0.15F}));
    addLeaves(works.roses, "shrub", 256, twig(3, 0.34F, {0.16F, 0.27F, 0.13F}, {0.42F, 0.50F, 0.27F}));
    addLeaves(works.ivy, "ivy", 256, ivy());
    addLeaves(works.lavender, "lavender", 256, lavender());
    addLeaves(works.reed, "reed", 256, reed());
    Material glass{.name = "glass"};
    glass.baseColour = {0.02F, 0.025F, 0.03F, 1};
    glass.roughness = 0.1F;
    scene.materials.push_back(glass);
    addMesh(scene, works.glass, static_cast<int>(scene.materials.size()) - 1);
    Material grass{.name = "grass"};
    grass.doubleSided = true;
    grass.roughness = 0.8F;
    scene.materials.push_back(grass);
    addMesh(scene, works.grass, static_cast<int>(scene.materials.size()) - 1);
}

} // namespace

Scene garden() {
    Works works;
    addGround(works);
    addWalls(works);
    addHouse(works);
    addPlanting(works);
    addGrass(works);
    addThings(works);
    Scene scene;
    furnish(scene, works);
    return scene;
}

} // namespace obscura::builtin
