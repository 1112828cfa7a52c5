#include "renderer/builtin/garden.h"

#include "renderer/builtin/clutter.h"
#include "renderer/builtin/furnishings.h"
#include "renderer/builtin/furniture.h"
#include "renderer/builtin/joinery.h"
#include "renderer/builtin/noise.h"
#include "renderer/builtin/plants.h"
#include "renderer/builtin/scenes.h"
#include "renderer/builtin/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

// A small garden behind a house: leaves that are cut out, blades of grass, thin bars. No
// technique's settings were tuned on it.
namespace obscura::builtin {

namespace garden_plan {

namespace {

void addPlanting(Works& works) {
    Random random(0, "builtin/garden/planting");
    const Tree apple = tree(4.4F, random);
    works.bark.add(apple.wood, at({-2.7F, 0, -0.9F}));
    works.leaves.add(apple.leaves, at({-2.7F, 0, -0.9F}));
    const Hedge west = hedge({2 * half.y - 0.1F, 1.75F, 0.75F}, 330, random);
    const glm::mat4 westPlace = at({-half.x - 0.3F, 0, 0}, 90);
    works.boxCore.add(west.core, westPlace);
    works.box.add(west.leaves, westPlace);
    const Hedge across = hedge({2 * half.y + 6, 2.2F, 0.9F}, 150, random);
    works.boxCore.add(across.core, at({lane + 0.4F, 0, 2.6F}, -90));
    works.box.add(across.leaves, at({lane + 0.4F, 0, 2.6F}, -90));

    struct Planted {
        float x, z, radius, height;
    };
    for (const Planted& each : {Planted{-1.0F, -3.45F, 0.5F, 1.15F},
                                {0.55F, -3.35F, 0.45F, 0.9F},
                                {3.6F, -3.4F, 0.55F, 1.3F},
                                {4.5F, -3.2F, 0.35F, 0.8F}}) {
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
    for (const glm::vec2 p :
         {glm::vec2(1.9F, -3.3F), {-3.6F, -3.4F}, {4.45F, 2.0F}, {4.55F, -1.6F}})
        works.reed.add(tuft(46, 0.95F, 0.55F, random),
                       at({p.x, p.y < bed ? bedHeight - 0.06F : 0.0F, p.y}));
    const Noise noise("builtin/garden/ivy");
    works.ivy.add(climber(
                      {-5, 0.3F}, {1.4F, 2.3F}, 330,
                      [&](glm::vec2 p) {
                          const float top = 2.25F - 0.28F * std::abs(p.x + 3.4F);
                          return std::min(1.0F, top - p.y) +
                                 0.5F * noise.value(glm::vec3(2.2F * p, 1));
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
    return 0.05F + 0.015F * cloud + 0.07F * ramp(0.22F, 0.02F, edge) +
           0.07F * ramp(0.6F, 0.2F, trunk);
}

void addGrass(Works& works) {
    Random random(0, "builtin/garden/grass");
    const Noise noise("builtin/garden/grass");
    works.grass = lawn(
        {-half.x, bed}, {half.x, terrace - 0.02F}, 1200,
        [&](glm::vec2 p) {
            for (const glm::vec2 step : steps)
                if (glm::length(p - step) < stepRadius)
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
    works.teak.add(trellis({1.3F, 1.6F}), at({1.6F, bedHeight - 0.06F, 0.05F - half.y}));
    works.ivy.add(climber(
                      {0.95F, 0.35F}, {2.25F, 1.95F}, 300,
                      [](glm::vec2 p) {
                          const float stem = std::abs(p.x - 1.6F - 0.35F * std::sin(3.1F * p.y));
                          return 0.5F - 1.6F * stem + 0.12F * std::sin(9 * p.x + 5 * p.y) -
                                 0.1F * p.y;
                      },
                      random),
                  at({0, 0, 0.085F - half.y}));
    // Leaves that have fallen.
    for (int i = 0; i < 130; ++i) {
        const float out = 1.9F * std::sqrt(between(random, 0, 1)), turn = between(random, 0, 6.28);
        const float way = between(random, 0, 6.28), up = between(random, -0.1, 0.25);
        const glm::vec3 foot(-2.7F + out * std::cos(turn), 0.045F, -0.7F + out * std::sin(turn));
        if (foot.z > bed + 0.2F)
            addCard(works.ivy, {foot,
                                0.06F * glm::normalize(glm::vec3(std::sin(way), up, std::cos(way))),
                                {0, 1, 0.2F},
                                0.055F,
                                0.2F});
    }
}

void furnishGarden(Scene& scene, const Works& works) {
    const auto add = [&](const Shape& shape, Material material, const Canvas& canvas,
                         const Painter& painter) {
        addMesh(scene, shape, addMaterial(scene, std::move(material), canvas, painter),
                canvas.metres);
    };
    const auto addLeaves = [&](const Shape& shape, const char* name, int size,
                               const Painter& painter) {
        addMesh(scene, shape, addCutOut(scene, name, size, painter));
    };
    add(works.brick, {.name = "bricks"}, {1024, 2}, bricks());
    add(works.stone, {.name = "stone"}, {512, 1.5F}, limestone());
    add(works.slabs, {.name = "slabs"}, {512, 1.5F}, limestone());
    add(works.house, {.name = "plaster"}, {512, 3}, plaster());
    add(works.paint, {.name = "paint", .roughness = 0.5F}, {256, 0.5F},
        speckle({0.42F, 0.50F, 0.47F}, 0.1F));
    add(works.earth, {.name = "earth"}, {512, 2}, earth());
    add(works.turf, {.name = "turf"}, {512, 2}, turf());
    add(works.bark, {.name = "bark"}, {512, 1}, bark());
    add(works.boxCore, {.name = "inside"}, {256, 1, false}, turf());
    add(works.iron, {.name = "iron", .roughness = 0.6F}, {256, 0.5F},
        speckle({0.14F, 0.15F, 0.15F}, 0.3F));
    add(works.teak, {.name = "teak"}, {512, 1},
        grain({0.42F, 0.34F, 0.26F}, {0.62F, 0.54F, 0.43F}));
    add(works.terracotta, {.name = "terracotta"}, {512, 1}, glaze({0.70F, 0.42F, 0.29F}));
    add(works.zinc, {.name = "zinc", .roughness = 0.5F}, {256, 0.5F},
        speckle({0.62F, 0.65F, 0.66F}, 0.2F));
    addLeaves(works.leaves, "apple", 512,
              twig(3, 0.23F, {0.14F, 0.25F, 0.07F}, {0.38F, 0.50F, 0.18F}));
    addLeaves(works.box, "box", 256, twig(3, 0.30F, {0.11F, 0.22F, 0.08F}, {0.30F, 0.43F, 0.15F}));
    addLeaves(works.roses, "shrub", 256,
              twig(3, 0.26F, {0.16F, 0.27F, 0.13F}, {0.42F, 0.50F, 0.27F}));
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

} // namespace garden_plan

Scene garden() {
    using namespace garden_plan;
    Works works;
    addGround(works);
    addWalls(works);
    addHouse(works);
    addPlanting(works);
    addGrass(works);
    addThings(works);
    Scene scene;
    furnishGarden(scene, works);
    Camera camera; // from the terrace, over table and lawn to the tree
    camera.position = {3.9, 1.6, 3.4};
    camera.target = {-2.0, 0.8, -2.0};
    camera.fovDegrees = 60;
    scene.cameras.push_back({"terrace", camera});
    return scene;
}

} // namespace obscura::builtin
