#include "renderer/builtin/clutter.h"
#include "renderer/builtin/furnishings.h"
#include "renderer/builtin/furniture.h"
#include "renderer/builtin/noise.h"
#include "renderer/builtin/room.h"

#include <array>
#include <utility>

namespace obscura::builtin::room_plan {

namespace {

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
        const glm::mat4 lean = pitched(spot * at({0, 0.127F, 0.02F}), -12);
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
            works.ceramic.add(
                tinted(mug(), {0.75F - 0.2F * part(i, 2), 0.62F, 0.40F + 0.2F * part(i, 2)}),
                spot * at({0.11F * part(i - 1, 1), 0, 0.03F * part(i % 2, 1)}, 70 * part(i, 1)));
        break;
    default: { // a globe
        works.brass.add(tinted(lathe({{0, 0},
                                      {0.07F, 0},
                                      {0.07F, 0.01F},
                                      {0.012F, 0.02F},
                                      {0.01F, 0.06F},
                                      {0, 0.06F}},
                                     20),
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
        ShelfPlan{0.40F, false, 7, 4}, {0.55F, true, 3, -1}, {0.86F, false, -1, -1},
        {0.40F, true, 2, 8},           {0.62F, true, 0, -1}, {0.80F, false, -1, 5},
        {0.36F, false, 9, 6},          {0.66F, true, 1, -1}, {0.80F, false, -1, 2},
        {0.45F, true, 6, 8},           {0.50F, true, 4, -1}, {0.42F, false, 0, 3}};
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
        works.paper.add(
            bookRow(plan.books * wide - 0.02F, std::min(0.29F, free - 0.03F), 0.21F, random),
            left * at({start, 0, 0.11F}));
        const float rest = (1 - plan.books) * wide, from = plan.right ? 0.0F : plan.books * wide;
        const bool two = plan.first >= 0 && plan.second >= 0;
        for (const auto& [kind, share] :
             {std::pair(plan.first, two ? 0.27F : 0.5F), {plan.second, two ? 0.76F : 0.5F}}) {
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
        const glm::mat4 spot = pitched(place * at({x, canvas.y / 2 + 0.034F, 0.065F}), -9);
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
    works.paper.add(bookRow(0.44F, 0.2F, 0.18F, random),
                    place * at({-0.22F, 0.23F + 0.01F, 0.15F}));
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

} // namespace

void addStorage(Works& works) {
    addShelves(works);
    addLedge(works);
    addSideboard(works);
}

} // namespace obscura::builtin::room_plan
