#include "renderer/builtin/clutter.h"
#include "renderer/builtin/furnishings.h"
#include "renderer/builtin/furniture.h"
#include "renderer/builtin/joinery.h"
#include "renderer/builtin/masonry.h"
#include "renderer/builtin/noise.h"
#include "renderer/builtin/scenes.h"
#include "renderer/builtin/textures.h"

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <utility>
#include <vector>

// A furnished room, made to be hard for what knows only the nearest surface: thin legs and bars,
// open shelves, books that lean, cloth, things below and behind other things. No technique's
// settings were tuned on it.
namespace obscura::builtin {

namespace {

// The plan, in metres: x from west to east, z from north to south.
constexpr glm::vec2 half{3, 2.3F}; // the inner faces of the walls
constexpr float ceiling = 2.62F, thick = 0.3F;
const Hole east{{-1.5F, 0.32F}, {0.7F, 2.28F}}; // windows; x along the wall seen from inside
const Hole north{{0.35F, 0.92F}, {1.75F, 2.28F}};
const Hole south{{1.22F, 0}, {2.07F, 2.04F}}; // the door

// One shape for each material.
struct Works {
    Shape walls, ceiling, paint, floor, oak, walnut, iron, brass, sofaCloth, cloth, linen, shade, ceramic,
        paper, wicker, rug, canvas, terracotta, leaves;
};

Shape flatFloor(glm::vec2 size, float y) {
    Shape shape = box({size.x, 0.2F, size.y}, 0);
    Shape placed;
    placed.add(shape, at({0, y, 0}));
    projectUv(placed);
    return placed;
}

// Places on the walls: x along the wall to the right for who looks at it, z into the room.
const glm::mat4 onNorth = at({0, 0, -half.y}), onSouth = at({0, 0, half.y}, 180),
                onWest = at({-half.x, 0, 0}, 90), onEast = at({half.x, 0, 0}, -90);

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
    works.iron.add(rod({-width / 2 - 0.1F, rail, 0, 0.011F}, {width / 2 + 0.1F, rail, 0, 0.011F}, 12),
                   place);
    for (const float side : {-1.0F, 1.0F}) {
        const float end = side * (width / 2 + 0.1F);
        works.iron.add(lathe({{0, -0.03F}, {0.02F, -0.02F}, {0.026F, 0}, {0.02F, 0.02F}, {0, 0.03F}}, 16),
                       place * at({end, rail, 0}));
        works.iron.add(rod({end - side * 0.06F, rail, 0, 0.008F},
                           {end - side * 0.06F, rail, -0.13F, 0.008F}),
                       place);
    }
}

void addDining(Works& works) {
    const glm::vec3 middle(1.45F, 0, -0.75F);
    const float top = 0.75F;
    works.oak.add(table({1.7F, top, 0.86F}), at(middle, 90));
    const Shape chair = windsorChair();
    for (const auto& [offset, turn] :
         {std::pair(glm::vec2(-0.60F, -0.40F), 84.0F), {glm::vec2(-0.66F, 0.38F), 97.0F},
          {glm::vec2(0.62F, -0.36F), -92.0F}, {glm::vec2(0.60F, 0.42F), -84.0F},
          {glm::vec2(0.03F, 1.12F), 187.0F}})
        works.oak.add(chair, at(middle + glm::vec3(offset.x, 0, offset.y), turn));
    const glm::mat4 on = at(middle + glm::vec3(0, top, 0));
    Random random(0, "builtin/room/dining");
    works.ceramic.add(tinted(bowl(0.16F, 0.085F), {0.88F, 0.86F, 0.80F}), on * at({0.02F, 0, 0.05F}));
    works.ceramic.add(fruit(0.16F, random), on * at({0.02F, 0, 0.05F}));
    for (const auto& [x, z, turn] : {std::array{-0.24F, -0.38F, 30.0F}, {0.23F, 0.36F, 130.0F}}) {
        works.ceramic.add(tinted(mug(), {0.33F, 0.45F, 0.50F}), on * at({x, 0, z}, turn));
        works.ceramic.add(tinted(plate(0.13F), {0.90F, 0.89F, 0.85F}), on * at({x, 0, z + 0.22F}));
    }
    works.brass.add(candlestick(0.27F), on * at({-0.08F, 0, -0.42F}));
    works.brass.add(candlestick(0.34F), on * at({0.06F, 0, -0.5F}));
    works.paper.add(openBook(), on * at({-0.22F, 0, 0.12F}, 78));
    const Lamp lamp = pendant(0.22F, 1.0F);
    works.shade.add(lamp.shade, at({middle.x, ceiling, middle.z}));
    works.iron.add(lamp.stand, at({middle.x, ceiling, middle.z}));
}

void addPillows(Works& works, const glm::mat4& seat) {
    struct Placed {
        glm::vec3 position;
        float turn, lean;
        glm::vec2 size;
        glm::vec3 colour;
    };
    for (const Placed& each :
         {Placed{{-0.68F, 0.475F, 0.06F}, 22, -20, {0.46F, 0.46F}, {0.74F, 0.53F, 0.22F}},
          {{-0.40F, 0.475F, 0.12F}, -6, -26, {0.42F, 0.40F}, {0.83F, 0.79F, 0.70F}},
          {{0.66F, 0.475F, 0.07F}, -24, -22, {0.46F, 0.46F}, {0.60F, 0.28F, 0.18F}}})
        works.cloth.add(tinted(pillow(each.size, 0.17F), each.colour),
                        seat * glm::rotate(at(each.position, each.turn), glm::radians(each.lean),
                                           glm::vec3(1, 0, 0)));
}

void addSitting(Works& works) {
    const glm::mat4 place = at({-2.48F, 0, 0.35F}, 90);
    const Upholstered couch = sofa(2.1F, 2), chair = sofa(0.92F, 1);
    works.sofaCloth.add(tinted(couch.cloth, {0.36F, 0.50F, 0.50F}), place);
    works.oak.add(couch.legs, place);
    addPillows(works, place);
    works.cloth.add(tinted(throwOver(0.17F, 0.5F, 0.30F, 0.10F), {0.78F, 0.72F, 0.62F}),
                    place * at({0.965F, 0.60F, 0.10F}));
    const glm::mat4 other = at({-0.72F, 0, 1.62F}, 205);
    works.sofaCloth.add(tinted(chair.cloth, {0.66F, 0.55F, 0.42F}), other);
    works.oak.add(chair.legs, other);
    const Rug carpet = rug({2.55F, 1.7F});
    works.rug.add(carpet.pile, at({-1.25F, 0.007F, 0.35F}, 2));
    works.linen.add(carpet.fringe, at({-1.25F, 0.0075F, 0.35F}, 2));

    const glm::vec3 middle(-1.28F, 0.017F, 0.35F);
    works.walnut.add(tripodTable(0.42F, 0.40F), at(middle, 15));
    const glm::mat4 on = at(middle + glm::vec3(0, 0.40F, 0));
    Random random(0, "builtin/room/sitting");
    works.paper.add(bookStack(3, random), on * at({-0.12F, 0, -0.14F}, 20));
    works.ceramic.add(tinted(mug(), {0.80F, 0.77F, 0.70F}), on * at({0.16F, 0, -0.1F}, 200));
    works.ceramic.add(tinted(bowl(0.09F, 0.05F), {0.25F, 0.36F, 0.42F}), on * at({0.1F, 0, 0.18F}));

    works.walnut.add(tripodTable(0.22F, 0.52F), at({-2.62F, 0, 1.72F}));
    const Lamp small = tableLamp(0.46F);
    works.ceramic.add(tinted(small.stand, {0.40F, 0.52F, 0.48F}), at({-2.66F, 0.52F, 1.74F}));
    works.shade.add(small.shade, at({-2.66F, 0.52F, 1.74F}));
    works.paper.add(bookStack(2, random), at({-2.52F, 0.52F, 1.6F}, 60));
    const Lamp lamp = floorLamp(1.62F);
    works.shade.add(lamp.shade, at({-2.6F, 0, -1.2F}, 20));
    works.iron.add(lamp.stand, at({-2.6F, 0, -1.2F}, 20));
}

// What stands on one board between two frames: books over a share of it, things beside them.
struct ShelfPlan {
    float books; // share of the width
    bool right;  // the books are on the right
    int first, second;
};

void addThing(Works& works, int kind, const glm::mat4& spot, float free, Random& random) {
    const float tall = 0.8F * free;
    switch (kind) {
    case 0:
        works.ceramic.add(tinted(vase(std::min(0.26F, tall)), {0.72F, 0.68F, 0.60F}), spot);
        break;
    case 1:
        works.ceramic.add(tinted(bowl(0.1F, 0.07F), {0.34F, 0.42F, 0.36F}), spot);
        break;
    case 2:
        works.terracotta.add(amphora(std::min(0.24F, tall)), spot);
        break;
    case 3:
        works.paper.add(bookStack(4, random), spot);
        break;
    case 4:
        works.wicker.add(basket(0.12F, 0.15F), spot);
        break;
    case 5:
        works.brass.add(candlestick(std::min(0.24F, tall)), spot);
        works.brass.add(candlestick(std::min(0.19F, tall)), spot * at({0.11F, 0, 0.03F}));
        break;
    case 6: { // a picture that leans
        const Picture image = picture({0.15F, 0.19F});
        const glm::mat4 lean = glm::rotate(spot * at({0, 0.127F, 0.02F}), glm::radians(-12.0F),
                                           glm::vec3(1, 0, 0));
        works.walnut.add(image.frame, lean);
        works.canvas.add(image.canvas, lean);
        break;
    }
    case 7: // boxes
        works.paper.add(tinted(rounded({0.26F, 0.12F, 0.2F}, 0.006F), {0.44F, 0.47F, 0.44F}),
                        spot * at({0, 0.06F, 0}));
        works.paper.add(tinted(rounded({0.22F, 0.09F, 0.17F}, 0.006F), {0.74F, 0.66F, 0.52F}),
                        spot * at({0.01F, 0.165F, 0}, 9));
        break;
    case 8: // mugs
        for (int i = 0; i < 3; ++i)
            works.ceramic.add(tinted(mug(), {0.75F - 0.2F * part(i, 2), 0.62F, 0.40F + 0.2F * part(i, 2)}),
                              spot * at({0.11F * part(i - 1, 1), 0, 0.03F * part(i % 2, 1)}, 70 * part(i, 1)));
        break;
    default: { // a globe
        works.brass.add(tinted(lathe({{0, 0}, {0.07F, 0}, {0.07F, 0.01F}, {0.012F, 0.02F}, {0.01F, 0.06F}, {0, 0.06F}}, 20),
                               {0.60F, 0.46F, 0.24F}),
                        spot);
        Outline ball{{0, 0.05F}};
        addArc(ball, {0, 0.15F}, 0.1F, -80, 80, 12);
        ball.emplace_back(0, 0.25F);
        works.ceramic.add(tinted(lathe(ball, 24), {0.36F, 0.50F, 0.58F}), spot);
    }
    }
}

void addShelves(Works& works) {
    constexpr std::array<float, 6> heights{0.14F, 0.52F, 0.88F, 1.24F, 1.58F, 1.92F};
    constexpr std::array<ShelfPlan, 12> plans{
        ShelfPlan{0.40F, false, 7, 4}, {0.55F, true, 3, -1}, {0.86F, false, -1, -1}, {0.40F, true, 2, 8},
        {0.62F, true, 0, -1},          {0.80F, false, -1, 5}, {0.36F, false, 9, 6},   {0.66F, true, 1, -1},
        {0.80F, false, -1, 2},         {0.45F, true, 6, 8},   {0.50F, true, 4, -1},   {0.42F, false, 0, 3}};
    const float width = 2.2F, each = width / 2;
    const glm::mat4 place = at({-1.35F, 0, 0.21F - half.y});
    const Shelves shelves = openShelves(width, 2, 0.27F, heights);
    works.walnut.add(shelves.boards, place);
    works.iron.add(shelves.bars, place);
    Random random(0, "builtin/room/shelves");
    const float wide = each - 0.05F;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const ShelfPlan& plan = plans[i];
        const std::size_t level = i / 2;
        const float free = level + 1 < heights.size()
                               ? heights[level + 1] - heights[level] - boardThickness
                               : 0.34F;
        const glm::mat4 left = place * at({each * (part(static_cast<int>(i % 2), 1) - 1) + 0.025F,
                                           heights[level] + 0.0005F, 0});
        const float start = plan.right ? (1 - plan.books) * wide : 0.0F;
        works.paper.add(bookRow(plan.books * wide - 0.02F, std::min(0.29F, free - 0.03F), 0.21F, random),
                        left * at({start, 0, 0.11F}));
        const float rest = (1 - plan.books) * wide, from = plan.right ? 0.0F : plan.books * wide;
        const bool two = plan.first >= 0 && plan.second >= 0;
        for (const auto& [kind, share] : {std::pair(plan.first, two ? 0.27F : 0.5F),
                                          {plan.second, two ? 0.76F : 0.5F}}) {
            const float out = between(random, -0.01, 0.02), turn = between(random, -14, 14);
            if (kind >= 0)
                addThing(works, kind, left * at({from + share * rest, 0, out}, turn), free, random);
        }
    }
}

// A narrow shelf above the sofa, on which pictures lean.
void addLedge(Works& works) {
    const glm::mat4 place = onWest * at({-0.35F, 1.32F, 0});
    Shape board = rounded({1.7F, 0.025F, 0.15F}, 0.004F);
    alongGrain(board);
    works.oak.add(board, place * at({0, -0.0125F, 0.076F}));
    for (const float x : {-0.6F, 0.0F, 0.6F}) {
        works.iron.add(rod({x, -0.02F, 0.13F, 0.005F}, {x, -0.15F, 0.004F, 0.005F}), place);
        works.iron.add(box({0.022F, 0.17F, 0.006F}, 0.002F), place * at({x, -0.105F, 0.003F}));
    }
    const auto lean = [&](float x, glm::vec2 canvas) {
        const Picture image = picture(canvas);
        const glm::mat4 spot = glm::rotate(place * at({x, canvas.y / 2 + 0.034F, 0.065F}),
                                           glm::radians(-9.0F), glm::vec3(1, 0, 0));
        works.walnut.add(image.frame, spot);
        works.canvas.add(image.canvas, spot);
    };
    lean(-0.5F, {0.42F, 0.32F});
    lean(0.02F, {0.26F, 0.34F});
    Random random(0, "builtin/room/ledge");
    addThing(works, 5, place * at({-0.14F, 0, 0.1F}), 0.3F, random);
    addThing(works, 2, place * at({0.34F, 0, 0.075F}, 60), 0.3F, random);
    works.paper.add(bookRow(0.26F, 0.2F, 0.13F, random), place * at({0.5F, 0.0005F, 0.14F}));
}

void addSideboard(Works& works) {
    const glm::vec3 size(1.7F, 0.76F, 0.40F);
    const glm::mat4 place = onSouth * at({-1.0F, 0, size.z / 2 + 0.03F});
    const Shelves board = sideboard(size);
    works.walnut.add(board.boards, place);
    works.brass.add(tinted(board.bars, {0.66F, 0.51F, 0.26F}), place);
    Random random(0, "builtin/room/sideboard");
    const glm::mat4 on = place * at({0, size.y, 0});
    works.ceramic.add(tinted(vase(0.32F), {0.24F, 0.33F, 0.40F}), on * at({-0.52F, 0, -0.02F}));
    works.ceramic.add(twigs(11, 0.62F, random), on * at({-0.52F, 0.31F, -0.02F}));
    works.paper.add(bookStack(3, random), on * at({0.1F, 0, 0.02F}, 8));
    works.ceramic.add(tinted(bowl(0.14F, 0.09F), {0.80F, 0.74F, 0.64F}), on * at({0.58F, 0, 0}));
    works.paper.add(bookRow(0.44F, 0.2F, 0.18F, random), place * at({-0.22F, 0.23F + 0.01F, 0.15F}));
    works.wicker.add(basket(0.13F, 0.15F), place * at({0.05F, 0.499F, 0.0F}));
    const auto hang = [&](glm::vec2 at2, glm::vec2 canvas) {
        const Picture image = picture(canvas);
        const glm::mat4 spot = onSouth * at({at2.x, at2.y, 0.014F});
        works.walnut.add(image.frame, spot);
        works.canvas.add(image.canvas, spot);
    };
    hang({-1.2F, 1.62F}, {0.7F, 0.5F});
    hang({-0.45F, 1.55F}, {0.28F, 0.36F});
}

void addPlantAndFloor(Works& works) {
    const glm::vec3 corner(2.5F, 0, 1.45F);
    works.terracotta.add(urn(0.36F), at({corner.x, 0, corner.z}));
    works.leaves.add(palm(13, 0.72F), at({corner.x, 0.30F, corner.z}, 35));
    works.wicker.add(basket(0.2F, 0.26F), at({-0.02F, 0, -1.55F}));
    works.cloth.add(tinted(pillow({0.36F, 0.3F}, 0.16F), {0.40F, 0.47F, 0.40F}),
                    glm::rotate(at({-0.02F, 0.09F, -1.5F}, 40), glm::radians(-32.0F), glm::vec3(1, 0, 0)));
    works.oak.add(stool(0.44F), at({0.4F, 0, 0.62F}, 50));
    Random random(0, "builtin/room/floor");
    works.paper.add(bookStack(6, random), at({-1.62F, 0.0F, -1.62F}, 12));
    works.paper.add(bookStack(2, random), at({0.4F, 0.44F, 0.62F}, 40));
    // A child's bricks and ball.
    constexpr std::array<glm::vec3, 4> colours{glm::vec3(0.74F, 0.28F, 0.20F), {0.82F, 0.66F, 0.28F},
                                               {0.30F, 0.46F, 0.58F}, {0.78F, 0.70F, 0.56F}};
    const Shape brick = box({0.05F, 0.05F, 0.05F}, 0.003F);
    for (int i = 0; i < 11; ++i) {
        const float x = between(random, -0.3, 0.3), z = between(random, -0.22, 0.22);
        works.paper.add(tinted(brick, colours[static_cast<std::size_t>(i % 4)]),
                        at({0.55F + x, 0.025F, 1.32F + z}, between(random, 0, 90)));
    }
    for (int i = 0; i < 4; ++i)
        works.paper.add(tinted(brick, colours[static_cast<std::size_t>(3 - i)]),
                        at({0.98F, 0.025F + 0.05F * part(i, 1), 1.1F}, 17 * part(i, 1)));
    Outline ball;
    addArc(ball, {0, 0.09F}, 0.09F, -90, 90, 14);
    ball.front().x = ball.back().x = 0;
    works.ceramic.add(tinted(lathe(ball, 26), {0.72F, 0.30F, 0.22F}), at({0.15F, 0, 1.9F}));
    // The lamp's cord to its socket.
    works.iron.add(tube(std::array{glm::vec4(-2.6F, 0.30F, -1.2F, 0.003F), glm::vec4(-2.64F, 0.03F, -1.26F, 0.003F),
                                   glm::vec4(-2.6F, 0.004F, -1.38F, 0.003F), glm::vec4(-2.68F, 0.004F, -1.5F, 0.003F),
                                   glm::vec4(-2.8F, 0.004F, -1.52F, 0.003F), glm::vec4(-2.9F, 0.03F, -1.6F, 0.003F),
                                   glm::vec4(-2.95F, 0.18F, -1.62F, 0.003F), glm::vec4(-2.975F, 0.25F, -1.62F, 0.008F)},
                        6));
    for (const glm::mat4& place : {onWest * at({1.62F, 0.25F, 0}), onSouth * at({1.0F, 1.05F, 0})})
        works.paint.add(box({0.08F, 0.08F, 0.012F}, 0.004F), place * at({0, 0, 0.005F}));
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

void furnish(Scene& scene, const Works& works) {
    const auto add = [&](const Shape& shape, Material material, const Canvas& canvas,
                         const Painter& painter) {
        addMesh(scene, shape, addMaterial(scene, std::move(material), canvas, painter), canvas.metres);
    };
    add(works.walls, {.name = "walls"}, {512, 3}, limewash({0.80F, 0.79F, 0.72F}));
    add(works.ceiling, {.name = "ceiling"}, {256, 2}, limewash({0.90F, 0.89F, 0.86F}));
    add(works.floor, {.name = "parquet"}, {1024, 2, true, true}, parquet());
    add(works.paint, {.name = "paint", .roughness = 0.5F}, {256, 0.5F}, speckle({0.88F, 0.87F, 0.82F}, 0.05F));
    add(works.oak, {.name = "oak"}, {512, 1, true, true},
        grain({0.50F, 0.34F, 0.20F}, {0.72F, 0.54F, 0.36F}));
    add(works.walnut, {.name = "walnut"}, {512, 1, true, true},
        grain({0.22F, 0.14F, 0.09F}, {0.40F, 0.27F, 0.18F}));
    add(works.iron, {.name = "iron", .roughness = 0.5F}, {256, 0.5F}, speckle({0.13F, 0.13F, 0.14F}, 0.2F));
    add(works.brass, {.name = "brass", .roughness = 0.4F}, {256, 0.5F}, speckle({1, 1, 1}, 0.12F));
    add(works.sofaCloth, {.name = "upholstery"}, {512, 0.5F}, weave(64));
    add(works.cloth, {.name = "wool", .doubleSided = true}, {512, 0.5F}, weave(128));
    add(works.linen, {.name = "linen", .doubleSided = true}, {512, 1},
        cloth({0.84F, 0.79F, 0.69F}, {0.74F, 0.66F, 0.52F}));
    add(works.shade, {.name = "shade"}, {256, 0.5F}, speckle({0.91F, 0.88F, 0.80F}, 0.06F));
    add(works.ceramic, {.name = "ceramic"}, {512, 0.5F, true, true}, glaze({0.95F, 0.95F, 0.95F}));
    add(works.paper, {.name = "paper"}, {256, 0.5F}, speckle({0.97F, 0.97F, 0.97F}, 0.12F));
    add(works.wicker, {.name = "wicker"}, {512, 0.25F}, grain({0.47F, 0.34F, 0.20F}, {0.70F, 0.55F, 0.36F}));
    add(works.rug, {.name = "rug"}, {1024, 1, false}, rugPattern());
    add(works.canvas, {.name = "painting"}, {512, 1, false}, painting());
    add(works.terracotta, {.name = "terracotta"}, {512, 0.5F, true, true}, glaze({0.68F, 0.40F, 0.27F}));
    add(works.leaves, {.name = "palm", .alphaCutoff = 0.5F, .doubleSided = true}, {512, 1, false}, frond());
}

} // namespace

Scene room() {
    Works works;
    addShell(works);
    addJoinery(works);
    addCurtains(works);
    addDining(works);
    addSitting(works);
    addShelves(works);
    addLedge(works);
    addSideboard(works);
    addPlantAndFloor(works);
    addBalcony(works);
    projectUv(works.walls);
    Scene scene;
    furnish(scene, works);
    return scene;
}

} // namespace obscura::builtin
