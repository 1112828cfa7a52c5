#pragma once

#include "renderer/builtin/shapes.h"

// What one sits on, eats at and keeps things in. Metres; stands on y = 0, centred on the y axis,
// and faces +z unless said otherwise.
namespace obscura::builtin {

// With turned legs, a bent bow and spindles; its seat is 0.45 m high.
Shape windsorChair();
// On four tapering legs under an apron.
Shape table(glm::vec3 size);
// Round, on three splayed legs.
Shape tripodTable(float radius, float height);
Shape stool(float height);

struct Upholstered {
    Shape cloth, legs;
};
// With arms, as wide as `width`, a cushion below and one behind each of its `seats`.
Upholstered sofa(float width, int seats);

// Boards at the given heights (of their tops), `width` apart between frames of thin bars; open on
// all sides.
struct Shelves {
    Shape boards, bars;
};
Shelves openShelves(float width, int bays, float depth, std::span<const float> heights);
constexpr float boardThickness = 0.024F;

// Drawers and doors on four thin legs.
Shelves sideboard(glm::vec3 size);

struct Lamp {
    Shape shade, stand;
};
// On three thin legs.
Lamp floorLamp(float height);
// Hangs by a cord from the origin, `drop` metres down to the shade's rim.
Lamp pendant(float radius, float drop);
Lamp tableLamp(float height);

} // namespace obscura::builtin
