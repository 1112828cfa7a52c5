#pragma once

#include "base/random.h"
#include "renderer/builtin/shapes.h"

#include <functional>

// What grows in the garden. Leaves are cards for a texture that is cut out by alpha: it runs along
// v from where the leaf or twig begins to its tip. Metres; stands on y = 0.
namespace obscura::builtin {

// One bent card: `along` from its foot to its tip, facing `out`.
struct Card {
    glm::vec3 foot, along, out;
    float width, bend; // how far the tip bends from `out` away, in lengths
};
void addCard(Shape& shape, const Card& card, int across = 1, int up = 2);

struct Tree {
    Shape wood, leaves;
};
Tree tree(float height, Random& random);
// A ball of twigs round a few stems.
Tree shrub(float radius, float height, float leaf, Random& random);
// Clipped, a box of the given size; `core` is what is dark behind its leaves.
struct Hedge {
    Shape core, leaves;
};
// Leaves are on top, at both ends of x and on the side of +z, which is what one sees of it.
Hedge hedge(glm::vec3 size, int leavesPerSquareMetre, Random& random);
// Clipped to a ball of this radius round the origin.
Hedge topiary(float radius, Random& random);
// Single leaves before a wall in the plane z = 0, where `grows` (x, y) is above 0: so many a square
// metre.
Shape climber(glm::vec2 low, glm::vec2 high, int leavesPerSquareMetre,
              const std::function<float(glm::vec2)>& grows, Random& random);
// Stalks that fan out from the origin.
Shape tuft(int stalks, float height, float spread, Random& random);
// Thin triangles, tinted; `grows` (x, z) says how high, 0 where there is none.
Shape lawn(glm::vec2 low, glm::vec2 high, int bladesPerSquareMetre,
           const std::function<float(glm::vec2)>& grows, Random& random);

} // namespace obscura::builtin
