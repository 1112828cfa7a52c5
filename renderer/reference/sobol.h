#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace obscura {

// Point `index` of a two-dimensional Owen-scrambled Sobol sequence in [0, 1)^2. Unlike `seed`s give
// independent scramblings, and the mean over scramblings is unbiased (Owen 1997; by hashing as in
// Burley, "Practical Hash-based Owen Scrambling", JCGT 9 (4), 2020). Runs of 2^k points are evenly
// spread.
glm::vec2 owenSobol(std::uint32_t index, std::uint32_t seed);

// The parts of owenSobol(), for those who make many points at once. Reversed bits have the first
// binary digit last.
constexpr std::uint32_t reversedBits(std::uint32_t bits) {
    bits = (bits << 16) | (bits >> 16);
    bits = ((bits & 0x00ff00ffu) << 8) | ((bits & 0xff00ff00u) >> 8);
    bits = ((bits & 0x0f0f0f0fu) << 4) | ((bits & 0xf0f0f0f0u) >> 4);
    bits = ((bits & 0x33333333u) << 2) | ((bits & 0xccccccccu) >> 2);
    return ((bits & 0x55555555u) << 1) | ((bits & 0xaaaaaaaau) >> 1);
}

// Flips each bit by a hash of the bits below it: on reversed numbers, of those above it, which is
// Owen's scrambling (Laine and Karras 2011, with the constants that Burley recommends).
constexpr std::uint32_t scrambledReversed(std::uint32_t bits, std::uint32_t seed) {
    bits ^= bits * 0x3d20adeau;
    bits += seed;
    bits *= (seed >> 16) | 1u;
    bits ^= bits * 0x05526c56u;
    bits ^= bits * 0x53a22864u;
    return bits;
}

// The second dimension's digits of a point; the first's are reversedBits(index). Its direction
// numbers: v_j = v_(j-1) xor (v_(j-1) >> 1), primitive polynomial x + 1.
constexpr std::uint32_t sobolSecondDimension(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 0x80000000u; index; index >>= 1, direction ^= direction >> 1)
        if (index & 1)
            result ^= direction;
    return result;
}

// A direction of the hemisphere around +z from a point of the unit square: density cosine / pi, or
// 1 / (2 pi). Both keep the square's even spread.
glm::vec3 cosineDirection(glm::vec2 point);
glm::vec3 uniformDirection(glm::vec2 point);

// A rotation whose third column is the unit vector n (Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 6 (1), 2017).
glm::mat3 basisAround(glm::vec3 n);

} // namespace obscura
