#pragma once

#include "renderer/builtin/shapes.h"

// What is fixed to a house. Metres; stands on y = 0, centred on the y axis, faces +z.
namespace obscura::builtin {

// Two casements in a frame, each of `rows` panes without glass; in the middle of a wall's hole.
Shape casements(glm::vec2 size, int rows);
// A frame of flat boards round a hole in a wall whose face is z = 0; with or without one below.
Shape architrave(glm::vec2 size, bool below);
// With two raised panels and a handle.
Shape panelDoor(glm::vec2 size);
// Cast iron: thin columns between rails, with its valve.
Shape radiator(int columns, float height);

// An iron fence along x of upright bars, `gap` apart, between two rails, with points on top.
Shape ironFence(float length, float height, float gap);
// Laths in both directions, held off the wall.
Shape trellis(glm::vec2 size);
// Its spout towards +x.
Shape wateringCan();
struct Bench {
    Shape wood, iron;
};
Bench gardenBench(float width);

} // namespace obscura::builtin
