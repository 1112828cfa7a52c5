#include "renderer/builtin/room.h"

#include "renderer/builtin/furnishings.h"
#include "renderer/builtin/joinery.h"
#include "renderer/builtin/scenes.h"
#include "renderer/builtin/textures.h"

#include <array>
#include <utility>
#include <vector>

// A furnished room, made to be hard for what knows only the nearest surface: thin legs and bars,
// open shelves, books that lean, cloth, things below and behind other things. No technique's
// settings were tuned on it.
namespace obscura::builtin {

namespace room_plan {

namespace {

constexpr float thick = 0.3F; // of the walls
// Windows and the door; x along the wall seen from inside.
const Hole east{{-1.5F, 0.32F}, {0.7F, 2.28F}};
const Hole north{{0.35F, 0.92F}, {1.75F, 2.28F}};
const Hole south{{1.22F, 0}, {2.07F, 2.04F}};

Shape flatFloor(glm::vec2 size, float y) {
    Shape shape = box({size.x, 0.2F, size.y}, 0);
    Shape placed;
    placed.add(shape, at({0, y, 0}));
    projectUv(placed);
    return placed;
}

void addShell(Works& works) {
    const glm::vec2 outside = half + thick;
    works.floor = flatFloor(2.0F * outside, -0.1F);
    works.ceiling = flatFloor(2.0F * outside, ceiling + 0.1F);
    const float height = ceiling + 0.1F, below = 0.05F; // into floor and ceiling
    const auto wall = [&](const glm::mat4& place, float length, std::vector<Hole> holes) {
        for (Hole& hole : holes) {
            hole.low.y += hole.low.y > 0 ? below : 0;
            hole.high.y += below;
        }
        works.walls.add(piercedWall({length, height, thick}, holes),
                        place * at({0, -below, -thick / 2}));
    };
    wall(onNorth, 2 * outside.x, {north});
    wall(onSouth, 2 * outside.x, {south});
    wall(onEast, 2 * half.y + 0.1F, {east});
    wall(onWest, 2 * half.y + 0.1F, {});
}

void addWindow(Works& works, const glm::mat4& place, const Hole& hole, int rows, bool sill) {
    const glm::vec2 size = hole.high - hole.low;
    const glm::mat4 corner = place * at({(hole.low.x + hole.high.x) / 2, hole.low.y, 0});
    works.paint.add(casements(size - 0.002F, rows), corner * at({0, 0.001F, -0.19F}));
    works.paint.add(architrave(size, !sill), corner);
    if (sill)
        works.paint.add(rounded({size.x + 0.2F, 0.03F, 0.24F}, 0.012F),
                        corner * at({0, -0.008F, -0.03F}));
}

void addJoinery(Works& works) {
    addWindow(works, onEast, east, 4, true);
    addWindow(works, onNorth, north, 3, true);
    const glm::mat4 door = onSouth * at({(south.low.x + south.high.x) / 2, 0, 0});
    works.paint.add(panelDoor(south.high - south.low), door * at({0, 0, -0.05F}));
    works.paint.add(architrave(south.high - south.low, false), door);
    // Skirting all round but for the door.
    const auto skirting = [&](const glm::mat4& place, float from, float to) {
        works.paint.add(box({to - from, 0.11F, 0.016F}, 0.004F),
                        place * at({(from + to) / 2, 0.055F, 0.007F}));
        works.paint.add(box({to - from, 0.016F, 0.026F}, 0.005F),
                        place * at({(from + to) / 2, 0.008F, 0.012F}));
    };
    skirting(onNorth, -half.x, half.x);
    skirting(onEast, -half.y, half.y);
    skirting(onWest, -half.y, half.y);
    skirting(onSouth, -half.x, south.low.x - 0.077F);
    skirting(onSouth, south.high.x + 0.077F, half.x);
    Outline cove{{0, -0.07F}, {0.008F, -0.07F}};
    addArc(cove, {0.075F, -0.065F}, 0.06F, 180, 90, 6);
    cove.insert(cove.end(), {{0.085F, -0.005F}, {0.085F, 0.01F}});
    works.paint.add(innerMoulding(cove, half), at({0, ceiling, 0}));
    works.paint.add(radiator(17, 0.62F), onNorth * at({1.0F, 0, 0.12F}));
}

void addCurtains(Works& works) {
    const float width = east.high.x - east.low.x + 0.7F, rail = 2.42F;
    const glm::mat4 place = onEast * at({(east.low.x + east.high.x) / 2, 0, 0.13F});
    works.linen.add(curtains(width, rail - 0.03F), place * at({0, 0.012F, 0}));
    works.iron.add(
        rod({-width / 2 - 0.1F, rail, 0, 0.011F}, {width / 2 + 0.1F, rail, 0, 0.011F}, 12), place);
    for (const float side : {-1.0F, 1.0F}) {
        const float end = side * (width / 2 + 0.1F);
        works.iron.add(
            lathe({{0, -0.03F}, {0.02F, -0.02F}, {0.026F, 0}, {0.02F, 0.02F}, {0, 0.03F}}, 16),
            place * at({end, rail, 0}));
        works.iron.add(
            rod({end - side * 0.06F, rail, 0, 0.008F}, {end - side * 0.06F, rail, -0.13F, 0.008F}),
            place);
    }
}

// Outside the large window: a slab with a railing.
void addBalcony(Works& works) {
    const float deep = 1.0F, wide = 3.4F;
    const glm::mat4 place = onEast * at({(east.low.x + east.high.x) / 2, 0, -thick - deep / 2});
    works.walls.add(box({wide, 0.16F, deep + 0.1F}, 0.01F), place * at({0, -0.14F, 0}));
    works.iron.add(ironFence(wide - 0.06F, 1.0F, 0.11F), place * at({0, -0.06F, 0.03F - deep / 2}));
    for (const float side : {-1.0F, 1.0F})
        works.iron.add(ironFence(deep - 0.06F, 1.0F, 0.11F),
                       place * at({side * (wide / 2 - 0.03F), -0.06F, 0.01F}, 90));
    works.terracotta.add(urn(0.4F), place * at({-1.2F, -0.06F, -0.05F}));
    works.leaves.add(palm(11, 0.6F), place * at({-1.2F, 0.26F, -0.05F}, 20));
}

void furnishRoom(Scene& scene, const Works& works) {
    const auto add = [&](const Shape& shape, Material material, const Canvas& canvas,
                         const Painter& painter) {
        addMesh(scene, shape, addMaterial(scene, std::move(material), canvas, painter),
                canvas.metres);
    };
    add(works.walls, {.name = "walls"}, {512, 3}, limewash({0.85F, 0.81F, 0.73F}));
    add(works.ceiling, {.name = "ceiling"}, {256, 2}, limewash({0.90F, 0.89F, 0.86F}));
    add(works.floor, {.name = "parquet"}, {1024, 2, true, true}, parquet());
    add(works.paint, {.name = "paint", .roughness = 0.5F}, {256, 0.5F},
        speckle({0.88F, 0.87F, 0.82F}, 0.05F));
    add(works.oak, {.name = "oak"}, {512, 1, true, true},
        grain({0.50F, 0.34F, 0.20F}, {0.72F, 0.54F, 0.36F}));
    add(works.walnut, {.name = "walnut"}, {512, 1, true, true},
        grain({0.22F, 0.14F, 0.09F}, {0.40F, 0.27F, 0.18F}));
    add(works.iron, {.name = "iron", .roughness = 0.5F}, {256, 0.5F},
        speckle({0.13F, 0.13F, 0.14F}, 0.2F));
    add(works.brass, {.name = "brass", .roughness = 0.4F}, {256, 0.5F}, speckle({1, 1, 1}, 0.12F));
    add(works.sofaCloth, {.name = "upholstery"}, {512, 0.5F}, weave(64));
    add(works.cloth, {.name = "wool", .doubleSided = true}, {512, 0.5F}, weave(128));
    add(works.linen, {.name = "linen", .doubleSided = true}, {512, 1},
        cloth({0.84F, 0.79F, 0.69F}, {0.74F, 0.66F, 0.52F}));
    add(works.shade, {.name = "shade"}, {256, 0.5F}, speckle({0.91F, 0.88F, 0.80F}, 0.06F));
    add(works.ceramic, {.name = "ceramic"}, {512, 0.5F, true, true}, glaze({0.95F, 0.95F, 0.95F}));
    add(works.paper, {.name = "paper"}, {256, 0.5F}, speckle({0.97F, 0.97F, 0.97F}, 0.12F));
    add(works.wicker, {.name = "wicker"}, {512, 0.25F},
        grain({0.47F, 0.34F, 0.20F}, {0.70F, 0.55F, 0.36F}));
    add(works.rug, {.name = "rug"}, {1024, 1, false}, rugPattern());
    add(works.canvas, {.name = "painting"}, {512, 1, false}, painting());
    add(works.terracotta, {.name = "terracotta"}, {512, 0.5F, true, true},
        glaze({0.68F, 0.40F, 0.27F}));
    addMesh(scene, works.leaves, addCutOut(scene, "palm", 512, frond()));
}

} // namespace

} // namespace room_plan

Scene room() {
    using namespace room_plan;
    Works works;
    addShell(works);
    addJoinery(works);
    addCurtains(works);
    addDining(works);
    addSitting(works);
    addStorage(works);
    addLyingAbout(works);
    addBalcony(works);
    projectUv(works.walls);
    Scene scene;
    furnishRoom(scene, works);
    return scene;
}

} // namespace obscura::builtin
