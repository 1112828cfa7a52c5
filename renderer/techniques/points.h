#pragma once

#include "renderer/techniques/settings.h"

namespace obscura {

// Sample points for shaders, by a technique's settings.

// `samples` points (xyz) spread evenly over the volume of the unit ball: the R3 sequence (Roberts
// 2018), which has no clumps at 8 points and converges at 4096.
std::vector<glm::vec4> ballPoints(const Settings& settings);
// The same directions, but with evenly spread lengths: points along evenly spread rays.
std::vector<glm::vec4> rayPoints(const Settings& settings);
// `samples` points (xy) spread evenly over the unit square: the R2 sequence, whose first n points
// are spread evenly too, for every n.
std::vector<glm::vec4> squarePoints(const Settings& settings);

// `samples` points (xyz) of LearnOpenGL's kernel around +z (de Vries 2020; Puri 2024, section 3.3):
// a point drawn evenly from the box |x|, |y| <= 1, 0 <= z <= 1 gives the direction alone. So a
// direction's likelihood grows with the cube of the distance to the box's wall: a corner is 5.2
// times as likely as the middle of a side. The i-th length is distributed evenly in
// [0, 0.1 + 0.9 (i / n)^2]: half of all points lie within 0.12. Where the original draws by chance,
// we take the R4 sequence: it has the same distribution, and every run has the same kernel.
std::vector<glm::vec4> boxKernel(const Settings& settings);

// `samples` unit vectors (xy), each the golden angle on from the one before: the arms on which
// shaders/ball.glsl lays out a disc.
std::vector<glm::vec4> goldenDirections(const Settings& settings);

} // namespace obscura
