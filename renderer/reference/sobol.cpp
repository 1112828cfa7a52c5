#include "renderer/reference/sobol.h"

#include <cmath>
#include <numbers>

namespace obscura {

namespace {

std::uint32_t scrambled(std::uint32_t bits, std::uint32_t seed) {
    return reversedBits(scrambledReversed(reversedBits(bits), seed));
}

std::uint32_t mixed(std::uint32_t value) { // Jarzynski and Olano 2020, "pcg"
    const std::uint32_t state = value * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

} // namespace

glm::vec2 owenSobol(std::uint32_t index, std::uint32_t seed) {
    const std::uint32_t shuffled = scrambled(index, mixed(seed));
    return {unit(scrambled(reversedBits(shuffled), mixed(seed ^ 0x68bc21ebu))),
            unit(scrambled(sobolSecondDimension(shuffled), mixed(seed ^ 0x02e5be93u)))};
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
