#include "renderer/sobol.h"

#include <cmath>
#include <numbers>

namespace obscura {

namespace {

std::uint32_t reversed(std::uint32_t bits) {
    bits = (bits << 16) | (bits >> 16);
    bits = ((bits & 0x00ff00ffu) << 8) | ((bits & 0xff00ff00u) >> 8);
    bits = ((bits & 0x0f0f0f0fu) << 4) | ((bits & 0xf0f0f0f0u) >> 4);
    bits = ((bits & 0x33333333u) << 2) | ((bits & 0xccccccccu) >> 2);
    return ((bits & 0x55555555u) << 1) | ((bits & 0xaaaaaaaau) >> 1);
}

// Flips each bit by a hash of the bits below it: on reversed numbers, of those above it, which is
// Owen's scrambling (Laine and Karras 2011, with the constants that Burley recommends).
std::uint32_t scrambledReversed(std::uint32_t bits, std::uint32_t seed) {
    bits ^= bits * 0x3d20adeau;
    bits += seed;
    bits *= (seed >> 16) | 1u;
    bits ^= bits * 0x05526c56u;
    bits ^= bits * 0x53a22864u;
    return bits;
}

std::uint32_t scrambled(std::uint32_t bits, std::uint32_t seed) {
    return reversed(scrambledReversed(reversed(bits), seed));
}

std::uint32_t mixed(std::uint32_t value) { // Jarzynski and Olano 2020, "pcg"
    const std::uint32_t state = value * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

// The second dimension's direction numbers: v_j = v_(j-1) xor (v_(j-1) >> 1), primitive polynomial
// x + 1.
std::uint32_t secondDimension(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 0x80000000u; index; index >>= 1, direction ^= direction >> 1)
        if (index & 1)
            result ^= direction;
    return result;
}

float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

} // namespace

glm::vec2 owenSobol(std::uint32_t index, std::uint32_t seed) {
    const std::uint32_t shuffled = scrambled(index, mixed(seed));
    return {unit(scrambled(reversed(shuffled), mixed(seed ^ 0x68bc21ebu))),
            unit(scrambled(secondDimension(shuffled), mixed(seed ^ 0x02e5be93u)))};
}

glm::vec3 cosineDirection(glm::vec2 point) {
    const float angle = 2 * std::numbers::pi_v<float> * point.y, length = std::sqrt(point.x);
    return {length * std::cos(angle), length * std::sin(angle), std::sqrt(1 - point.x)};
}

glm::vec3 uniformDirection(glm::vec2 point) {
    const float angle = 2 * std::numbers::pi_v<float> * point.y;
    const float z = 1 - point.x, length = std::sqrt(std::fmax(0.0f, 1 - z * z));
    return {length * std::cos(angle), length * std::sin(angle), z};
}

glm::mat3 basisAround(glm::vec3 n) {
    const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

} // namespace obscura
