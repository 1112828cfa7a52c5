#pragma once

#include "renderer/scene/gltf_piece.h"
#include "renderer/scene/gltf_primitive.h"

#include <glm/glm.hpp>

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// How a node shows a primitive.
struct GltfPose {
    std::vector<double> weights;           // of morph targets, as many as there are or fewer
    std::vector<glm::dmat4> worldFromMesh; // one for all vertices that are used, or one for each
    // Which sets of texture coordinates become Vertex::uv and Vertex::uv1; -1: none.
    std::array<int, 2> coordinates{0, -1};
};

// Gives the piece the vertices in `used` of a primitive: morphed, posed, in world space. Faults of
// values that are not positions are mended and told to `warn`.
void readVertices(const GltfFile& file, const GltfPrimitive& primitive,
                  std::span<const std::uint32_t> used, const GltfPose& pose,
                  const std::function<void(const std::string&)>& warn, Piece& piece);

} // namespace obscura
