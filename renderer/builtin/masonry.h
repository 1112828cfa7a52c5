#pragma once

#include "renderer/builtin/shapes.h"

#include <span>

// Walls and stonework. Everything stands on y = 0 and is centred on the y axis unless said
// otherwise; metres.
namespace obscura::builtin {

// Fluted, on an Attic base, with a capital of two rings of leaves; `radius` at the shaft's foot.
Shape grandColumn(float radius, float height);
// Smooth, with a moulded capital.
Shape plainColumn(float radius, float height);
// A square pillar with the same mouldings as `plainColumn`.
Shape pier(glm::vec2 size, float height);
// With a moulded foot and cap, as high as the balustrade beside it.
Shape pedestal(float width, float height);
Shape baluster(float height);

// A wall along x, its faces at z = ±thickness / 2, with a round arch in the middle of each bay.
struct ArchedWall {
    float bay, radius, springing, top, thickness;
    float foot; // where the wall begins: at the springing if columns carry it, else at the floor
};
Shape archedWall(const ArchedWall& wall);
// A solid wall along x, standing on y = 0, with rectangular holes; its middle is at x = z = 0.
struct Hole {
    glm::vec2 low, high; // (x, y)
};
Shape piercedWall(glm::vec3 size, std::span<const Hole> holes);
// The ring of cut stones round its arch, with a larger keystone; proud of it on all sides.
Shape voussoirs(const ArchedWall& wall, int count, float width);

// Groined, over a bay of the given half sizes; springs from y = 0 and faces down.
Shape groinVault(glm::vec2 half, float rise);
// Half an ellipse across z, from -half to half, on which vaults meet.
Shape rib(float half, float rise, float width);

// Rings along the inside of a rectangle (half sizes); x is the distance inwards.
Shape innerMoulding(const Outline& outline, glm::vec2 half);
Shape cornice(glm::vec2 half, float depth, float height);
// Blocks below a cornice, `spacing` apart; y = 0 is their top.
Shape dentils(glm::vec2 half, glm::vec3 size, float spacing);

} // namespace obscura::builtin
