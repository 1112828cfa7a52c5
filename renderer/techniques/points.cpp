#include "renderer/techniques/points.h"

#include <cmath>
#include <numbers>

namespace obscura {

namespace {

// Coordinate `power` of point i of the R sequence with that root (Roberts 2018).
double coordinate(double root, double power, int i) {
    const double value = 0.5 + (i + 1) / std::pow(root, power);
    return value - std::floor(value);
}

int countOf(const Settings& settings) { return static_cast<int>(settings["samples"]); }

// Directions are spread evenly; lengths are uniform numbers to the power `lengthPower`.
std::vector<glm::vec4> pointsInBall(int count, double lengthPower) {
    constexpr double root = 1.2207440846057596; // of x^4 = x + 1
    std::vector<glm::vec4> points;
    for (int i = 0; i < count; ++i) {
        const double z = 2 * coordinate(root, 1, i) - 1;
        const double angle = 2 * std::numbers::pi * coordinate(root, 2, i);
        const double length = std::pow(coordinate(root, 3, i), lengthPower);
        const double flat = std::sqrt(1 - z * z);
        points.emplace_back(length * flat * std::cos(angle), length * flat * std::sin(angle),
                            length * z, 0);
    }
    return points;
}

} // namespace

std::vector<glm::vec4> ballPoints(const Settings& settings) {
    return pointsInBall(countOf(settings), 1.0 / 3);
}

std::vector<glm::vec4> rayPoints(const Settings& settings) {
    return pointsInBall(countOf(settings), 1);
}

std::vector<glm::vec4> squarePoints(const Settings& settings) {
    constexpr double root = 1.3247179572447461; // of x^3 = x + 1
    std::vector<glm::vec4> points;
    for (int i = 0; i < countOf(settings); ++i)
        points.emplace_back(coordinate(root, 1, i), coordinate(root, 2, i), 0, 0);
    return points;
}

std::vector<glm::vec4> boxKernel(const Settings& settings) {
    constexpr double root = 1.1673039782614187; // of x^5 = x + 1
    const int count = countOf(settings);
    std::vector<glm::vec4> points;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 inBox(2 * coordinate(root, 1, i) - 1, 2 * coordinate(root, 2, i) - 1,
                               coordinate(root, 3, i));
        const double share = static_cast<double>(i) / count;
        const double length = coordinate(root, 4, i) * (0.1 + 0.9 * share * share);
        points.emplace_back(glm::normalize(inBox) * length, 0);
    }
    return points;
}

std::vector<glm::vec4> goldenDirections(const Settings& settings) {
    const double turn = 2 * std::numbers::pi * (2 - std::numbers::phi);
    std::vector<glm::vec4> points;
    for (int i = 0; i < countOf(settings); ++i)
        points.emplace_back(std::cos(i * turn), std::sin(i * turn), 0, 0);
    return points;
}

} // namespace obscura
