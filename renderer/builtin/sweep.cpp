#include "renderer/builtin/shapes.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace obscura::builtin {

void addArc(Outline& outline, glm::vec2 centre, float radius, float fromDegrees, float toDegrees,
            int steps) {
    for (int i = 0; i <= steps; ++i) {
        const float angle = glm::radians(glm::mix(fromDegrees, toDegrees, part(i, steps)));
        outline.push_back(centre + radius * glm::vec2(std::cos(angle), std::sin(angle)));
    }
}

Outline circle(float radius, int steps) {
    Outline outline;
    addArc(outline, {0, 0}, radius, 0, 360, steps);
    outline.back() = outline.front();
    return outline;
}

namespace {

struct Corner {
    glm::vec2 point, normal;
    float along;
};

glm::vec2 rightOf(glm::vec2 from, glm::vec2 to) {
    const glm::vec2 direction = glm::normalize(to - from);
    return {direction.y, -direction.x};
}

// The outline with a normal at each point; a sharp edge has two corners in one place.
std::vector<Corner> cornersOf(Outline outline) {
    outline.erase(std::unique(outline.begin(), outline.end()), outline.end());
    const std::size_t last = outline.size() - 1;
    const bool closed = outline.front() == outline.back();
    std::vector<Corner> corners;
    float along = 0;
    for (std::size_t i = 0; i <= last; ++i) {
        along += i > 0 ? glm::distance(outline[i - 1], outline[i]) : 0;
        const std::size_t before = i > 0 ? i - 1 : (closed ? last - 1 : 0);
        const std::size_t after = i < last ? i + 1 : (closed ? 1 : last);
        const bool first = before == i, end = after == i;
        const glm::vec2 in = rightOf(outline[first ? i : before], outline[first ? i + 1 : i]);
        const glm::vec2 out = rightOf(outline[end ? i - 1 : i], outline[end ? i : after]);
        if (glm::dot(in, out) > 0.82F) // the cosine of 35 degrees
            corners.push_back({outline[i], glm::normalize(in + out), along});
        else
            corners.insert(corners.end(), {{outline[i], in, along}, {outline[i], out, along}});
    }
    return corners;
}

} // namespace

Shape sweep(const Outline& outline, std::span<const Station> stations) {
    Shape shape;
    const std::vector<Corner> corners = cornersOf(outline);
    for (const Corner& corner : corners)
        for (const Station& station : stations) {
            Vertex vertex;
            vertex.position =
                station.origin + corner.point.x * station.across + corner.point.y * station.up;
            vertex.normal = glm::normalize(corner.normal.x * station.facing +
                                           corner.normal.y * glm::normalize(station.up));
            vertex.uv = {station.along, corner.along};
            shape.vertices.push_back(vertex);
        }
    shape.addCells(static_cast<int>(stations.size()) - 1, static_cast<int>(corners.size()) - 1);
    return shape;
}

Shape lathe(const Outline& outline, int segments) {
    float widest = 0;
    for (const glm::vec2& point : outline)
        widest = std::max(widest, point.x);
    std::vector<Station> stations;
    for (int i = 0; i <= segments; ++i) {
        const float angle = glm::two_pi<float>() * part(i % segments, segments);
        const glm::vec3 out(std::sin(angle), 0, std::cos(angle));
        const float along = glm::two_pi<float>() * part(i, segments) * widest;
        stations.push_back({{0, 0, 0}, out, {0, 1, 0}, out, along});
    }
    return sweep(outline, stations);
}

Shape moulding(const Outline& outline, std::span<const glm::vec2> plan) {
    const auto right = [&](std::size_t i) { // of the side that begins at point i
        const glm::vec2 side = plan[(i + 1) % plan.size()] - plan[i % plan.size()];
        return glm::normalize(glm::vec3(-side.y, 0, side.x));
    };
    Shape shape;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const std::size_t next = (i + 1) % plan.size();
        const glm::vec3 facing = right(i);
        const auto mitre = [&](glm::vec3 other) {
            return (facing + other) / (1 + glm::dot(facing, other));
        };
        const float length = glm::distance(plan[i], plan[next]);
        const std::array<Station, 2> stations{
            Station{
                {plan[i].x, 0, plan[i].y}, mitre(right(i + plan.size() - 1)), {0, 1, 0}, facing, 0},
            Station{
                {plan[next].x, 0, plan[next].y}, mitre(right(next)), {0, 1, 0}, facing, length}};
        shape.add(sweep(outline, stations));
    }
    return shape;
}

Shape pillar(const Outline& outline, glm::vec2 size) {
    const glm::vec2 half = size / 2.0F;
    const std::array<glm::vec2, 4> plan{half, glm::vec2(half.x, -half.y), -half,
                                        glm::vec2(-half.x, half.y)};
    return moulding(outline, plan);
}

Shape arch(const Outline& outline, std::span<const glm::vec3> path, glm::vec3 centre) {
    std::vector<Station> stations;
    float along = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const std::size_t before = i > 0 ? i - 1 : 0;
        const std::size_t after = std::min(i + 1, path.size() - 1);
        along += glm::distance(path[before], path[i]);
        const glm::vec3 direction = glm::normalize(path[after] - path[before]);
        const glm::vec3 outwards = path[i] - centre;
        const glm::vec3 across =
            glm::normalize(outwards - glm::dot(outwards, direction) * direction);
        stations.push_back({path[i], across, glm::cross(across, direction), across, along});
    }
    return sweep(outline, stations);
}

namespace {

// A flat end, facing along `direction`.
void addEnd(Shape& shape, const Station& station, glm::vec3 direction, int sides) {
    const auto first = static_cast<std::uint32_t>(shape.vertices.size());
    for (int i = 0; i < sides; ++i) {
        const float angle = glm::two_pi<float>() * part(i, sides);
        const glm::vec3 out = std::cos(angle) * station.across + std::sin(angle) * station.up;
        const glm::vec2 flat =
            glm::length(station.across) * glm::vec2(std::cos(angle), std::sin(angle));
        shape.vertices.push_back({station.origin + out, direction, {}, flat});
    }
    const bool ahead = glm::dot(glm::cross(station.across, station.up), direction) > 0;
    for (std::uint32_t i = 2; i < static_cast<std::uint32_t>(sides); ++i)
        shape.addTriangle(first, first + i - (ahead ? 1U : 0U), first + i - (ahead ? 0U : 1U));
}

} // namespace

Shape tube(std::span<const glm::vec4> path, int sides) {
    const std::size_t last = path.size() - 1;
    const auto point = [&](std::size_t i) { return glm::vec3(path[i]); };
    std::vector<Station> stations;
    glm::vec3 across(0), direction(0), first(0);
    float along = 0;
    for (std::size_t i = 0; i <= last; ++i) {
        direction = glm::normalize(point(std::min(i + 1, last)) - point(i > 0 ? i - 1 : 0));
        if (i == 0) { // any direction across the first, then as little turn as there can be
            first = direction;
            across = std::abs(direction.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        } else
            along += glm::distance(point(i - 1), point(i));
        across = glm::normalize(across - glm::dot(across, direction) * direction);
        const glm::vec3 up = glm::cross(across, direction);
        stations.push_back({point(i), path[i].w * across, path[i].w * up, across, along});
    }
    Shape shape = sweep(circle(1, sides), stations);
    for (Vertex& vertex : shape.vertices)
        vertex.uv.y *= path[0].w;
    addEnd(shape, stations.front(), -first, sides);
    addEnd(shape, stations.back(), direction, sides);
    return shape;
}

Shape rod(glm::vec4 from, glm::vec4 to, int sides) { return tube(std::array{from, to}, sides); }

} // namespace obscura::builtin
