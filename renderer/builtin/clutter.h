#pragma once

#include "base/random.h"
#include "renderer/builtin/shapes.h"

// What lies about in a room. Metres; stands on y = 0, centred on the y axis, unless said otherwise.
// Colours are the vertices'.
namespace obscura::builtin {

// A row of upright books along +x from the origin, their spines at z = 0, facing +z, none deeper or
// higher than given; the last one leans.
Shape bookRow(float length, float height, float depth, Random& random);
Shape bookStack(int count, Random& random);
Shape openBook();

Shape bowl(float radius, float height);
Shape fruit(float bowlRadius, Random& random); // for a bowl that stands on y = 0
Shape mug();
Shape plate(float radius);
Shape vase(float height);
// Twigs that stand in a vase whose mouth is at the origin.
Shape twigs(int count, float length, Random& random);
Shape candlestick(float height);
Shape basket(float radius, float height);
// Full in its middle, thin at its seam; upright, its lower seam at y = 0.
Shape pillow(glm::vec2 size, float thickness);
// A cloth thrown over a thing of this width (along x), its top at y = 0; it hangs down on both
// sides.
Shape throwOver(float across, float width, float leftDrop, float rightDrop);
// A rug with a fringe at both ends of x; its texture covers it once.
struct Rug {
    Shape pile, fringe;
};
Rug rug(glm::vec2 size);
// In the plane z = 0, facing +z, its middle at the origin; the canvas' texture covers it once.
struct Picture {
    Shape frame, canvas;
};
Picture picture(glm::vec2 size);

} // namespace obscura::builtin
