#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// The sample sets of VAO++ (Bokšanský, Pospíšil and Bittner 2017, section 4.5): points of the unit
// disc that pixels of a 3 x 3 tile read at nine rotations, 40 degrees apart. Together the nine must
// fill the disc evenly. obscura-poisson-sets makes poisson_sets.h of this.

constexpr int poissonRotations = 9;
constexpr int poissonSizes[] = {2, 4, 8, 16, 32};

// Makes one set. Darts are thrown so that every point stays away from all nine rotations of the
// others and of itself; then each point takes the rotation that spreads the set widest; then points
// are put into z-order.
std::vector<glm::dvec2> poissonSet(int size, std::uint64_t seed);

// The least distance between any two of the nine rotations of all points.
double leastDistance(std::span<const glm::dvec2> points);

// Interleaved bits of both coordinates, 16 of each: neighbours on this curve are neighbours on the
// screen, and so in the depth buffer's cache lines.
std::uint32_t zOrder(glm::dvec2 point);

// All sets as the text of poisson_sets.h.
std::string poissonTable(std::uint64_t seed);

} // namespace obscura
