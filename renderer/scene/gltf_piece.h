#pragma once

#include "renderer/scene/scene.h"

#include <cstdint>
#include <vector>

namespace obscura {

// A primitive while it is read: its corners, three a triangle, as indices into the vertices that
// they use.
struct Piece {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> corners;
};

// The unit vector, or zero where there is no direction: of zero, and of what is not finite.
glm::vec3 direction(const glm::dvec3& v);

// Gives every triangle its own flat normal, as glTF asks where a primitive has none.
void makeFlat(Piece& piece);

// Replaces normals that are no direction by those of the triangles around. Returns how many there
// were.
std::size_t mendNormals(Piece& piece);

// Far from zero, texture coordinates lose their digits, and shaders bound them (material.glsl):
// such a piece's triangles are moved next to zero, each on its own, by whole periods of a texture
// that repeats along u, along v or along both, mirrored or not.
void recentre(Piece& piece, bool alongU, bool alongV);

} // namespace obscura
