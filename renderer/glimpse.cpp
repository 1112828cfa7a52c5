#include "renderer/glimpse.h"

#include "base/percentile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

namespace obscura {

namespace {

constexpr int pictureHeight = 27;

// `count` directions all around, evenly (Gonzalez 2010, "Measurement of areas on a sphere using
// Fibonacci and latitude-longitude lattices").
std::vector<glm::vec3> allAround(int count) {
    std::vector<glm::vec3> result;
    for (int i = 0; i < count; ++i) {
        const double y = 1 - (2.0 * i + 1) / count,
                     turn = 2 * std::numbers::pi * i / std::numbers::phi, r = std::sqrt(1 - y * y);
        result.emplace_back(r * std::cos(turn), y, r * std::sin(turn));
    }
    return result;
}

} // namespace

Glimpse glimpse(const Sight& sight, const Camera& camera, double aspect, double size) {
    const int width = std::max(static_cast<int>(std::lround(pictureHeight * aspect)), 1);
    const Frame frame = makeFrame(camera, width, pictureHeight, sight.bounds(), 1);
    const glm::vec3 eye(camera.position[0], camera.position[1], camera.position[2]);
    std::map<std::tuple<int, int, int>, double> kinds;
    std::vector<double> depths;
    for (int y = 0; y < pictureHeight; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec4 ahead(
                (static_cast<float>(x) + 0.5f) * frame.size.z * frame.viewFromUv.x +
                    frame.viewFromUv.z,
                (static_cast<float>(y) + 0.5f) * frame.size.w * frame.viewFromUv.y +
                    frame.viewFromUv.w,
                -1, 0);
            const float slant = glm::length(glm::vec3(ahead));
            const auto seen = sight.along(eye, glm::vec3(frame.worldFromView * ahead) / slant);
            if (!seen) {
                ++kinds[{-1, 0, 0}];
                continue;
            }
            const auto depth = static_cast<double>(seen->distance / slant);
            depths.push_back(depth);
            const glm::vec3 n = glm::abs(seen->faceNormal);
            const int axis = n.x > n.y && n.x > n.z ? 0 : n.y > n.z ? 1 : 2;
            ++kinds[{sight.materialAt(seen->firstIndex),
                     seen->faceNormal[axis] < 0 ? axis : axis + 3,
                     static_cast<int>(std::floor(2 * std::log2(depth / size + 1e-9)))}];
        }
    Glimpse result;
    const auto all = static_cast<double>(width * pictureHeight);
    for (const auto& [kind, count] : kinds)
        result.variety -= count / all * std::log2(count / all);
    result.shown = static_cast<double>(depths.size()) / all;
    if (depths.empty())
        return result;
    const auto shares = percentiles(depths, std::array{0.0, 0.05, 0.5});
    result.first = shares[0];
    result.near = shares[1];
    result.middle = shares[2];
    return result;
}

Around around(const Sight& sight, const glm::vec3& eye) {
    static const std::vector<glm::vec3> directions = allAround(96);
    double met = 0, asked = 0, backs = 0, nearest = std::numeric_limits<double>::infinity();
    for (const glm::vec3& direction : directions) {
        if (const auto solid = sight.along(eye, direction, true))
            backs += !solid->front;
        const auto seen = sight.along(eye, direction);
        if (seen)
            nearest = std::min(nearest, static_cast<double>(seen->distance));
        if (direction.y > -0.3f) {
            ++asked;
            met += seen.has_value();
        }
    }
    return {met / asked, backs / static_cast<double>(directions.size()), nearest};
}

} // namespace obscura
