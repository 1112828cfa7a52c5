#include "renderer/points.h"

#include <cmath>
#include <numbers>

namespace obscura {

std::vector<glm::vec4> ballPoints(const Settings& settings) {
    constexpr double root = 1.2207440846057596; // of x^4 = x + 1
    const int count = static_cast<int>(settings["samples"]);
    std::vector<glm::vec4> points;
    for (int i = 0; i < count; ++i) {
        const auto coordinate = [&](double power) {
            const double value = 0.5 + (i + 1) / std::pow(root, power);
            return value - std::floor(value);
        };
        const double z = 2 * coordinate(1) - 1, angle = 2 * std::numbers::pi * coordinate(2);
        const double length = std::cbrt(coordinate(3)), flat = std::sqrt(1 - z * z);
        points.emplace_back(length * flat * std::cos(angle), length * flat * std::sin(angle),
                            length * z, 0);
    }
    return points;
}

} // namespace obscura
