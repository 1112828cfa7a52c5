#include "renderer/techniques/disc_points.h"

#include "renderer/techniques/poisson.h"
#include "renderer/techniques/poisson_sets.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace obscura {

std::vector<glm::vec4> poissonDiscPoints(const Settings& settings) {
    std::vector<glm::vec4> points;
    for (const auto& [x, y] : poissonSets)
        points.emplace_back(x, y, 0, 0);
    const int count = static_cast<int>(settings["samples"]);
    if (std::find(std::begin(poissonSizes), std::end(poissonSizes), count) !=
        std::end(poissonSizes))
        return points;
    for (int i = 0; i < count; ++i) {
        const double radius = std::sqrt((i + 0.5) / count);
        const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0, 0);
    }
    std::sort(points.end() - count, points.end(), [](const glm::vec4& a, const glm::vec4& b) {
        return zOrder(glm::dvec2(a)) < zOrder(glm::dvec2(b));
    });
    return points;
}

} // namespace obscura
