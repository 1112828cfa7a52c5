#pragma once

#include "renderer/builtin/shapes.h"

#include <array>

// The garden's plan, and what is built in it.
namespace obscura::builtin::garden_plan {

// The plan, in metres: x from west to east, z from north to south. To the north a brick wall, to
// the west a hedge, to the east a low wall with a fence and beyond it a lane and another hedge, to
// the south the house.
inline constexpr glm::vec2 half{5, 4};
inline constexpr float terrace = 2.1F; // z where it begins
inline constexpr float bed = -2.75F;   // z where the raised bed ends
inline constexpr float bedHeight = 0.38F;
inline constexpr float lane = 8.2F; // x where it ends
inline constexpr float gate = 0.9F; // z of its middle

// One shape for each material.
struct Works {
    Shape brick, stone, slabs, house, paint, earth, turf, grass, bark, leaves, box, boxCore, roses,
        ivy, lavender, reed, iron, teak, terracotta, zinc, glass;
};

// Stepping stones from the terrace to the gate, (x, z), and how far each reaches.
inline constexpr std::array<glm::vec2, 6> steps{glm::vec2(0.7F, 1.72F), {1.35F, 1.4F},
                                                {2.05F, 1.15F},         {2.75F, 1.0F},
                                                {3.5F, 0.92F},          {4.25F, 0.9F}};
inline constexpr float stepRadius = 0.27F;

void addGround(Works& works); // lawn, beds, paving
void addWalls(Works& works);  // with fence and gate
void addHouse(Works& works);

} // namespace obscura::builtin::garden_plan
