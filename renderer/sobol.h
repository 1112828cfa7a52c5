#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace obscura {

// Point `index` of a two-dimensional Owen-scrambled Sobol sequence in [0, 1)^2. Unlike `seed`s give
// independent scramblings, and the mean over scramblings is unbiased (Owen 1997; by hashing as in
// Burley, "Practical Hash-based Owen Scrambling", JCGT 9 (4), 2020). Runs of 2^k points are evenly
// spread.
glm::vec2 owenSobol(std::uint32_t index, std::uint32_t seed);

// A direction of the hemisphere around +z from a point of the unit square: density cosine / pi, or
// 1 / (2 pi). Both keep the square's even spread.
glm::vec3 cosineDirection(glm::vec2 point);
glm::vec3 uniformDirection(glm::vec2 point);

// A rotation whose third column is the unit vector n (Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 6 (1), 2017).
glm::mat3 basisAround(glm::vec3 n);

} // namespace obscura
