#pragma once

#include "renderer/scene/gltf_primitive.h"

#include <glm/glm.hpp>

#include <optional>
#include <span>
#include <vector>

namespace obscura {

// From the mesh to the world by each joint of a skin, as the joints' nodes stand in the file: the
// rest pose (glTF 2.0, section 3.7.3). Joints outside of the scene stand at the origin.
std::vector<glm::dmat4> jointsOf(const GltfFile& file, const tinygltf::Model& model, int skin,
                                 std::span<const std::optional<glm::dmat4>> worldFromNode);

// From the mesh to the world for each of the vertices in `used`: section 3.7.3.3, with as many sets
// of joints and weights as the primitive has. A skinned mesh hangs on its joints alone, wherever
// its own node is.
std::vector<glm::dmat4> skinned(const GltfFile& file, const GltfPrimitive& primitive,
                                std::span<const glm::dmat4> joints,
                                std::span<const std::uint32_t> used);

} // namespace obscura
