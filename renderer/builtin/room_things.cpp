#include "renderer/builtin/clutter.h"
#include "renderer/builtin/furnishings.h"
#include "renderer/builtin/furniture.h"
#include "renderer/builtin/noise.h"
#include "renderer/builtin/room.h"

#include <array>
#include <utility>

namespace obscura::builtin::room_plan {

void addDining(Works& works) {
    const glm::vec3 middle(1.45F, 0, -0.75F);
    const float top = 0.75F;
    works.oak.add(table({1.7F, top, 0.86F}), at(middle, 90));
    const Shape chair = windsorChair();
    for (const auto& [offset, turn] : {std::pair(glm::vec2(-0.60F, -0.40F), 84.0F),
                                       {glm::vec2(-0.66F, 0.38F), 97.0F},
                                       {glm::vec2(0.62F, -0.36F), -92.0F},
                                       {glm::vec2(0.60F, 0.42F), -84.0F},
                                       {glm::vec2(0.03F, 1.12F), 187.0F}})
        works.oak.add(chair, at(middle + glm::vec3(offset.x, 0, offset.y), turn));
    const glm::mat4 on = at(middle + glm::vec3(0, top, 0));
    Random random(0, "builtin/room/dining");
    works.ceramic.add(tinted(bowl(0.16F, 0.085F), {0.88F, 0.86F, 0.80F}),
                      on * at({0.02F, 0, 0.05F}));
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

namespace {

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
                        seat * pitched(at(each.position, each.turn), each.lean));
}

} // namespace

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

void addLyingAbout(Works& works) {
    const glm::vec3 corner(2.5F, 0, 1.45F);
    works.terracotta.add(urn(0.36F), at({corner.x, 0, corner.z}));
    works.leaves.add(palm(13, 0.72F), at({corner.x, 0.30F, corner.z}, 35));
    works.wicker.add(basket(0.2F, 0.26F), at({-0.02F, 0, -1.55F}));
    works.cloth.add(tinted(pillow({0.36F, 0.3F}, 0.16F), {0.40F, 0.47F, 0.40F}),
                    pitched(at({-0.02F, 0.09F, -1.5F}, 40), -32));
    works.oak.add(stool(0.44F), at({0.4F, 0, 0.62F}, 50));
    Random random(0, "builtin/room/floor");
    works.paper.add(bookStack(6, random), at({-1.62F, 0.0F, -1.62F}, 12));
    works.paper.add(bookStack(2, random), at({0.4F, 0.44F, 0.62F}, 40));
    // A child's bricks and ball.
    constexpr std::array<glm::vec3, 4> colours{glm::vec3(0.74F, 0.28F, 0.20F),
                                               {0.82F, 0.66F, 0.28F},
                                               {0.30F, 0.46F, 0.58F},
                                               {0.78F, 0.70F, 0.56F}};
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
    works.iron.add(tube(
        std::array{
            glm::vec4(-2.6F, 0.30F, -1.2F, 0.003F), glm::vec4(-2.64F, 0.03F, -1.26F, 0.003F),
            glm::vec4(-2.6F, 0.004F, -1.38F, 0.003F), glm::vec4(-2.68F, 0.004F, -1.5F, 0.003F),
            glm::vec4(-2.8F, 0.004F, -1.52F, 0.003F), glm::vec4(-2.9F, 0.03F, -1.6F, 0.003F),
            glm::vec4(-2.95F, 0.18F, -1.62F, 0.003F), glm::vec4(-2.975F, 0.25F, -1.62F, 0.008F)},
        6));
    for (const glm::mat4& place : {onWest * at({1.62F, 0.25F, 0}), onSouth * at({1.0F, 1.05F, 0})})
        works.paint.add(box({0.08F, 0.08F, 0.012F}, 0.004F), place * at({0, 0, 0.005F}));
}

} // namespace obscura::builtin::room_plan
