#include "renderer/builtin/shapes.h"

#include "image/image.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace obscura::builtin {

void Shape::add(const Shape& part, const glm::mat4& place) {
    const glm::mat3 turn(place);
    const glm::mat3 normalTurn = glm::transpose(glm::inverse(turn));
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (Vertex vertex : part.vertices) {
        vertex.position = glm::vec3(place * glm::vec4(vertex.position, 1));
        vertex.normal = glm::normalize(normalTurn * vertex.normal);
        vertices.push_back(vertex);
    }
    const bool mirrored = glm::determinant(turn) < 0;
    for (std::size_t i = 0; i < part.indices.size(); i += 3) {
        indices.push_back(first + part.indices[i]);
        indices.push_back(first + part.indices[i + (mirrored ? 2 : 1)]);
        indices.push_back(first + part.indices[i + (mirrored ? 1 : 2)]);
    }
}

void Shape::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::vec3 corner = vertices[a].position;
    const glm::vec3 doubleArea =
        glm::cross(vertices[b].position - corner, vertices[c].position - corner);
    if (glm::length(doubleArea) > 2e-7F) // 0.1 mm²
        indices.insert(indices.end(), {a, b, c});
}

void Shape::addQuad(const std::array<std::uint32_t, 4>& corners) {
    const auto agreement = [&](std::size_t a, std::size_t b, std::size_t c) {
        const Vertex &va = vertices[corners[a]], &vb = vertices[corners[b]],
                     &vc = vertices[corners[c]];
        const glm::vec3 face = glm::cross(vb.position - va.position, vc.position - va.position);
        const float area = std::max(glm::length(face), 1e-12F);
        return glm::dot(face, va.normal + vb.normal + vc.normal) / area;
    };
    // A flat quad is split along its first diagonal, whatever the rounding.
    const float first = std::min(agreement(0, 1, 2), agreement(0, 2, 3)) + 1e-4F;
    const float second = std::min(agreement(0, 1, 3), agreement(1, 2, 3));
    const std::size_t other = first >= second ? 2 : 3;
    addTriangle(corners[0], corners[1], corners[other]);
    addTriangle(corners[other == 2 ? 0 : 1], corners[2], corners[3]);
}

void Shape::addCells(int across, int up) {
    const int row = across + 1;
    const int first = static_cast<int>(vertices.size()) - row * (up + 1);
    for (int j = 0; j < up; ++j)
        for (int i = 0; i < across; ++i) {
            const auto a = static_cast<std::uint32_t>(first + j * row + i);
            const auto b = a + static_cast<std::uint32_t>(row);
            addQuad({a, a + 1, b + 1, b});
        }
}

void addMesh(Scene& scene, const Shape& shape, int material, float textureMetres) {
    Mesh mesh;
    mesh.firstIndex = static_cast<std::uint32_t>(scene.indices.size());
    mesh.indexCount = static_cast<std::uint32_t>(shape.indices.size());
    mesh.material = material;
    // Vertices that only belonged to triangles of no area stay behind.
    constexpr std::uint32_t none = ~0U;
    std::vector<std::uint32_t> places(shape.vertices.size(), none);
    for (const std::uint32_t index : shape.indices) {
        if (places[index] == none) {
            places[index] = static_cast<std::uint32_t>(scene.vertices.size());
            scene.vertices.push_back(shape.vertices[index]);
            scene.vertices.back().uv /= textureMetres;
        }
        scene.indices.push_back(places[index]);
    }
    scene.meshes.push_back(mesh);
    if (scene.materials[static_cast<std::size_t>(material)].normalTexture.exists())
        deriveTangents(scene, mesh);
}

Shape tinted(Shape shape, glm::vec3 colour) {
    const glm::vec4 linear(linearFromSrgb(colour.r), linearFromSrgb(colour.g),
                           linearFromSrgb(colour.b), 1);
    for (Vertex& vertex : shape.vertices)
        vertex.colour = linear;
    return shape;
}

glm::mat4 at(glm::vec3 position, float turnDegrees) {
    return glm::rotate(glm::translate(glm::mat4(1), position), glm::radians(turnDegrees),
                       glm::vec3(0, 1, 0));
}

glm::mat4 pitched(const glm::mat4& place, float degrees) {
    return glm::rotate(place, glm::radians(degrees), glm::vec3(1, 0, 0));
}

glm::mat4 rolled(const glm::mat4& place, float degrees) {
    return glm::rotate(place, glm::radians(degrees), glm::vec3(0, 0, 1));
}

namespace {

// By differences that stay inside the unit square; at a pole, from a little way off.
glm::vec3 normalOf(const Surface& surface, glm::vec2 uv) {
    const float step = 1e-3F;
    const glm::vec2 low = glm::max(uv - step, 0.0F);
    const glm::vec2 high = glm::min(uv + step, 1.0F);
    const glm::vec3 du = surface({high.x, uv.y}) - surface({low.x, uv.y});
    const glm::vec3 dv = surface({uv.x, high.y}) - surface({uv.x, low.y});
    const glm::vec3 normal = glm::cross(du, dv);
    if (glm::length(normal) > 1e-3F * (glm::dot(du, du) + glm::dot(dv, dv)))
        return glm::normalize(normal);
    return normalOf(surface, glm::mix(uv, glm::vec2(0.5F), 0.02F));
}

} // namespace

Shape patch(const Surface& surface, int across, int up, glm::vec2 metres) {
    Shape shape;
    for (int j = 0; j <= up; ++j)
        for (int i = 0; i <= across; ++i) {
            const glm::vec2 uv(part(i, across), part(j, up));
            shape.vertices.push_back({surface(uv), normalOf(surface, uv), {}, uv * metres});
        }
    shape.addCells(across, up);
    mendNormals(shape);
    splitFolds(shape);
    return shape;
}

void deform(Shape& shape, const Mapping& mapping) {
    const float step = 1e-3F;
    for (Vertex& vertex : shape.vertices) {
        glm::mat3 slope;
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 offset(0);
            offset[axis] = step;
            slope[axis] = mapping(vertex.position + offset) - mapping(vertex.position - offset);
        }
        vertex.normal =
            glm::normalize(glm::inverse(glm::transpose(slope / (2 * step))) * vertex.normal);
        vertex.position = mapping(vertex.position);
    }
}

void mendNormals(Shape& shape) {
    std::vector<bool> wrong(shape.vertices.size());
    std::vector<glm::vec3> faces(shape.vertices.size());
    for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
        const auto vertex = [&](std::size_t k) { return shape.vertices[shape.indices[i + k]]; };
        const glm::vec3 a = vertex(0).position;
        const glm::vec3 face = glm::cross(vertex(1).position - a, vertex(2).position - a);
        for (std::size_t k = 0; k < 3; ++k) {
            faces[shape.indices[i + k]] += face;
            if (glm::dot(face, vertex(k).normal) <= 0)
                wrong[shape.indices[i + k]] = true;
        }
    }
    for (std::size_t i = 0; i < wrong.size(); ++i)
        if (wrong[i] && glm::length(faces[i]) > 0)
            shape.vertices[i].normal = glm::normalize(faces[i]);
}

void splitFolds(Shape& shape) {
    const std::vector<std::uint32_t> before = std::move(shape.indices);
    shape.indices.clear();
    for (std::size_t i = 0; i < before.size(); i += 3) {
        std::array<Vertex, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = shape.vertices[before[i + k]];
        const glm::vec3 face = glm::cross(corners[1].position - corners[0].position,
                                          corners[2].position - corners[0].position);
        auto first = before[i], second = before[i + 1], third = before[i + 2];
        if (glm::dot(face, corners[0].normal + corners[1].normal + corners[2].normal) <= 0 &&
            glm::length(face) > 0) {
            first = static_cast<std::uint32_t>(shape.vertices.size());
            second = first + 1;
            third = first + 2;
            for (Vertex& corner : corners)
                corner.normal = glm::normalize(face);
            shape.vertices.insert(shape.vertices.end(), corners.begin(), corners.end());
        }
        shape.addTriangle(first, second, third);
    }
}

void projectUv(Shape& shape) {
    for (Vertex& vertex : shape.vertices) {
        const glm::vec3 size = glm::abs(vertex.normal);
        const glm::vec3 p = vertex.position;
        if (size.y >= size.x && size.y >= size.z)
            vertex.uv = {p.x, p.z};
        else
            vertex.uv = {size.x >= size.z ? p.z : p.x, -p.y};
    }
}

void alongGrain(Shape& piece) {
    glm::vec3 low(1e9F), high(-1e9F);
    for (const Vertex& vertex : piece.vertices) {
        low = glm::min(low, vertex.position);
        high = glm::max(high, vertex.position);
    }
    const glm::vec3 size = high - low;
    const auto longest = [](glm::vec3 v) {
        return v.x >= v.y && v.x >= v.z ? 0 : (v.y >= v.z ? 1 : 2);
    };
    const int fibres = longest(size);
    const float other = 7.3F * (size.x + 3 * size.y + 9 * size.z); // another part of the tree
    for (Vertex& vertex : piece.vertices) {
        const int facing = longest(glm::abs(vertex.normal));
        const int u = facing == fibres ? (fibres + 1) % 3 : fibres;
        vertex.uv = {vertex.position[u] + other, vertex.position[3 - facing - u] + 1.7F * other};
    }
}

namespace {

// The box's 24 vertices: each face's own corners, drawn in by the chamfer. Bit i of `corner` says
// on which side of axis i it lies.
std::uint32_t boxVertex(int axis, unsigned corner) {
    return static_cast<std::uint32_t>(axis) * 8 + corner;
}

Vertex chamferedCorner(glm::vec3 size, float bevel, int axis, unsigned corner) {
    const glm::vec3 signs =
        glm::vec3(corner & 1U, corner >> 1U & 1U, corner >> 2U & 1U) * 2.0F - 1.0F;
    Vertex vertex;
    vertex.position = signs * (size / 2.0F - bevel);
    vertex.position[axis] = signs[axis] * size[axis] / 2.0F;
    vertex.normal[axis] = signs[axis];
    vertex.uv = {vertex.position[axis == 0 ? 2 : 0], -vertex.position[axis == 1 ? 2 : 1]};
    return vertex;
}

// Turned so that it faces away from the box's centre.
void addTriangle(Shape& shape, std::array<std::uint32_t, 3> corners) {
    const auto position = [&](std::size_t i) { return shape.vertices[corners[i]].position; };
    const glm::vec3 normal = glm::cross(position(1) - position(0), position(2) - position(0));
    if (glm::dot(normal, position(0)) < 0)
        std::swap(corners[1], corners[2]);
    shape.addTriangle(corners[0], corners[1], corners[2]);
}
void addSquare(Shape& shape, const std::array<std::uint32_t, 4>& corners) {
    addTriangle(shape, {corners[0], corners[1], corners[2]});
    addTriangle(shape, {corners[0], corners[2], corners[3]});
}

} // namespace

Shape box(glm::vec3 size, float bevel) {
    Shape shape;
    for (int axis = 0; axis < 3; ++axis)
        for (unsigned corner = 0; corner < 8; ++corner)
            shape.vertices.push_back(chamferedCorner(size, bevel, axis, corner));
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3;
        const unsigned a = 1U << axis, b = 1U << next, c = 7U - a - b;
        for (const unsigned end : {0U, a}) {
            addSquare(shape, {boxVertex(axis, end), boxVertex(axis, end | b),
                              boxVertex(axis, end | b | c), boxVertex(axis, end | c)});
            for (const unsigned side : {0U, b})
                addSquare(shape, {boxVertex(axis, end | side), boxVertex(axis, end | side | c),
                                  boxVertex(next, end | side | c), boxVertex(next, end | side)});
        }
    }
    for (unsigned corner = 0; corner < 8; ++corner)
        addTriangle(shape, {boxVertex(0, corner), boxVertex(1, corner), boxVertex(2, corner)});
    return shape;
}

namespace {

// The lines of a grid on one face of the box round a rounded one: close together where it bends.
std::vector<float> gridLines(float half, float radius, int cells, int arc) {
    std::vector<float> lines;
    for (int i = arc; i > 0; --i)
        lines.push_back(radius - half - radius * std::tan(glm::quarter_pi<float>() * part(i, arc)));
    for (int i = 0; i <= cells; ++i)
        lines.push_back((half - radius) * (2 * part(i, cells) - 1));
    for (int i = arc; i > 0; --i)
        lines.push_back(-lines[static_cast<std::size_t>(i - 1)]);
    return lines;
}

} // namespace

Shape rounded(glm::vec3 size, float radius, int cells, int arc) {
    const glm::vec3 half = size / 2.0F;
    Shape shape;
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const float sign = face % 2 == 0 ? 1.0F : -1.0F;
        const int across = (axis + (sign > 0 ? 1 : 2)) % 3, up = (axis + (sign > 0 ? 2 : 1)) % 3;
        const std::vector<float> x = gridLines(half[across], radius, cells, arc);
        const std::vector<float> y = gridLines(half[up], radius, cells, arc);
        for (const float b : y)
            for (const float a : x) {
                glm::vec3 p;
                p[axis] = sign * half[axis];
                p[across] = a;
                p[up] = b;
                const glm::vec3 inner = glm::clamp(p, radius - half, half - radius);
                const glm::vec3 normal = glm::normalize(p - inner);
                shape.vertices.push_back({inner + radius * normal, normal, {}, {a, b}});
            }
        shape.addCells(static_cast<int>(x.size()) - 1, static_cast<int>(y.size()) - 1);
    }
    return shape;
}

} // namespace obscura::builtin
