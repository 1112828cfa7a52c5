#include "renderer/scene/gltf_piece.h"

#include <algorithm>
#include <cmath>

namespace obscura {

glm::vec3 direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 1e-30 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0);
}

void makeFlat(Piece& piece) {
    std::vector<Vertex> split;
    split.reserve(piece.corners.size());
    for (std::size_t i = 0; i < piece.corners.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return piece.vertices[piece.corners[i + k]]; };
        const glm::dvec3 a(corner(0).position), b(corner(1).position), c(corner(2).position);
        const glm::vec3 normal = direction(glm::cross(b - a, c - a));
        for (std::size_t k = 0; k < 3; ++k) {
            Vertex vertex = corner(k);
            vertex.normal = normal == glm::vec3(0) ? glm::vec3(0, 1, 0) : normal;
            split.push_back(vertex);
        }
    }
    piece.vertices = std::move(split);
    for (std::size_t i = 0; i < piece.corners.size(); ++i)
        piece.corners[i] = static_cast<std::uint32_t>(i);
}

std::size_t mendNormals(Piece& piece) {
    std::vector<std::size_t> lost;
    for (std::size_t i = 0; i < piece.vertices.size(); ++i)
        if (piece.vertices[i].normal == glm::vec3(0))
            lost.push_back(i);
    if (lost.empty())
        return 0;
    std::vector<glm::dvec3> sums(piece.vertices.size(), glm::dvec3(0));
    for (std::size_t i = 0; i < piece.corners.size(); i += 3) {
        const auto at = [&](std::size_t k) {
            return glm::dvec3(piece.vertices[piece.corners[i + k]].position);
        };
        const glm::dvec3 area = glm::cross(at(1) - at(0), at(2) - at(0));
        for (std::size_t k = 0; k < 3; ++k)
            sums[piece.corners[i + k]] += area;
    }
    for (const std::size_t i : lost) {
        const glm::vec3 normal = direction(sums[i]);
        piece.vertices[i].normal = normal == glm::vec3(0) ? glm::vec3(0, 1, 0) : normal;
    }
    return lost.size();
}

void recentre(Piece& piece, bool alongU, bool alongV) {
    constexpr float far = 512;
    const bool any =
        std::any_of(piece.vertices.begin(), piece.vertices.end(), [&](const Vertex& vertex) {
            return (alongU && std::abs(vertex.uv.x) > far) ||
                   (alongV && std::abs(vertex.uv.y) > far);
        });
    if (!any)
        return;
    std::vector<Vertex> split;
    split.reserve(piece.corners.size());
    for (std::size_t i = 0; i < piece.corners.size(); i += 3) {
        glm::vec2 middle(0);
        for (std::size_t k = 0; k < 3; ++k)
            middle += piece.vertices[piece.corners[i + k]].uv / 3.0f;
        const glm::vec2 periods = 2.0f * glm::floor(middle / 2.0f);
        for (std::size_t k = 0; k < 3; ++k) {
            Vertex vertex = piece.vertices[piece.corners[i + k]];
            vertex.uv -= glm::vec2(alongU ? periods.x : 0, alongV ? periods.y : 0);
            split.push_back(vertex);
        }
    }
    piece.vertices = std::move(split);
    for (std::size_t i = 0; i < piece.corners.size(); ++i)
        piece.corners[i] = static_cast<std::uint32_t>(i);
}

} // namespace obscura
