#include "bench/motion/reprojection.h"

#include <array>
#include <cmath>

namespace obscura {

namespace {

// The pixels that a bilinear fetch reads.
struct Tap {
    int x, y;
    float weight;
};
std::array<Tap, 4> tapsAt(glm::vec2 place) {
    const glm::vec2 first = glm::floor(place), share = place - first;
    const int x = static_cast<int>(first.x), y = static_cast<int>(first.y);
    return {Tap{x, y, (1 - share.x) * (1 - share.y)}, Tap{x + 1, y, share.x * (1 - share.y)},
            Tap{x, y + 1, (1 - share.x) * share.y}, Tap{x + 1, y + 1, share.x * share.y}};
}

// Nearer to a centre than a thousandth of a pixel is at it: rounding must not bring in neighbours.
glm::vec2 snapped(glm::vec2 place) {
    const glm::vec2 centre = glm::round(place);
    for (int axis = 0; axis < 2; ++axis)
        if (std::abs(place[axis] - centre[axis]) < 1e-3f)
            place[axis] = centre[axis];
    return place;
}

// A surface point in a frame's view space.
struct Point {
    glm::vec3 position, normal, faceNormal;
};

class Reprojector {
  public:
    Reprojector(const Surfaces& from, const Surfaces& to)
        : from_(from), to_(to), toFromFrom_(to.frame.viewFromWorld * from.frame.worldFromView) {}

    struct Found {
        glm::vec2 place{-1, -1};
        std::int64_t seen = -1;
    };

    Found find(int x, int y) const {
        const std::size_t i = from_.index(x, from_.height - 1 - y);
        if (from_.empty(i))
            return {};
        const glm::vec3 position = from_.position(
            static_cast<float>(x), static_cast<float>(from_.height - 1 - y), from_.depth[i]);
        const glm::mat3 turn(toFromFrom_);
        const Point point{glm::vec3(toFromFrom_ * glm::vec4(position, 1)), turn * from_.normal[i],
                          turn * from_.faceNormal[i]};
        if (-point.position.z < to_.frame.depth.x)
            return {};
        Found found{snapped(pixelOf(point.position)), -1};
        float nearest = 0;
        bool all = true;
        for (const Tap& tap : tapsAt(found.place)) {
            if (!(tap.weight > 0))
                continue;
            all &= shows(tap, point, 0.5f, 0.906f); // the cosine of 25 degrees
            if (tap.weight > nearest && shows(tap, point, 2, -1)) {
                nearest = tap.weight;
                found.seen = static_cast<std::int64_t>(tap.y) * to_.width + tap.x;
            }
        }
        return all ? found : Found{{-1, -1}, found.seen};
    }

  private:
    glm::vec2 pixelOf(glm::vec3 position) const {
        const Frame& frame = to_.frame;
        const glm::vec2 perDepth = glm::vec2(position) / -position.z;
        const glm::vec2 uv = (perDepth - glm::vec2(frame.viewFromUv.z, frame.viewFromUv.w)) /
                             glm::vec2(frame.viewFromUv);
        return {uv.x * frame.size.x - 0.5f, (1 - uv.y) * frame.size.y - 0.5f};
    }

    // The point's surface, within so many pixels' widths of its tangent plane.
    bool shows(const Tap& tap, const Point& point, float pixels, float leastCosine) const {
        if (tap.x < 0 || tap.y < 0 || tap.x >= to_.width || tap.y >= to_.height)
            return false;
        const int row = to_.height - 1 - tap.y;
        const std::size_t i = to_.index(tap.x, row);
        if (to_.empty(i))
            return false;
        const glm::vec3 found =
            to_.position(static_cast<float>(tap.x), static_cast<float>(row), to_.depth[i]);
        const float pixel = to_.depth[i] * std::abs(to_.frame.viewFromUv.y) * to_.frame.size.w;
        return std::abs(glm::dot(point.faceNormal, found - point.position)) < pixels * pixel &&
               glm::dot(point.normal, to_.normal[i]) > leastCosine;
    }

    const Surfaces& from_;
    const Surfaces& to_;
    glm::mat4 toFromFrom_;
};

} // namespace

Reprojection::Reprojection(const Surfaces& from, const Surfaces& to) {
    const Reprojector reprojector(from, to);
    for (int y = 0; y < from.height; ++y)
        for (int x = 0; x < from.width; ++x) {
            const auto found = reprojector.find(x, y);
            places_.push_back(found.place);
            seen_.push_back(found.seen);
        }
}

std::optional<std::size_t> Reprojection::seenAt(std::size_t pixel) const {
    return seen_[pixel] < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(seen_[pixel]));
}

float Reprojection::fetch(const Image& image, std::size_t pixel) const {
    float sum = 0;
    for (const Tap& tap : tapsAt(places_[pixel]))
        if (tap.weight > 0)
            sum += tap.weight * image.at(tap.x, tap.y, 0);
    return sum;
}

} // namespace obscura
