#pragma once

#include "renderer/builtin/masonry.h"

// The furnished room's plan, and what stands in it. Metres; x from west to east, z from north to
// south, the floor at y = 0.
namespace obscura::builtin::room_plan {

inline constexpr glm::vec2 half{3, 2.3F}; // the inner faces of the walls
inline constexpr float ceiling = 2.62F;

// Places on the walls: x along the wall to the right for who looks at it, z into the room.
inline const glm::mat4 onNorth = at({0, 0, -half.y}), onSouth = at({0, 0, half.y}, 180),
                       onWest = at({-half.x, 0, 0}, 90), onEast = at({half.x, 0, 0}, -90);

// One shape for each material.
struct Works {
    Shape walls, ceiling, paint, floor, oak, walnut, iron, brass, sofaCloth, cloth, linen, shade,
        ceramic, paper, wicker, rug, canvas, terracotta, leaves;
};

void addDining(Works& works);  // a table with its chairs, laid, under a lamp
void addSitting(Works& works); // sofa, armchair, small tables, rug, lamps
void addStorage(Works& works); // shelves, a ledge, a sideboard, and what stands on them
void addLyingAbout(Works& works);

} // namespace obscura::builtin::room_plan
