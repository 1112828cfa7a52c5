#pragma once

#include "renderer/scene/gltf_file.h"
#include "renderer/scene/scene.h"

#include <glm/glm.hpp>
#include <tiny_gltf.h>

#include <optional>
#include <vector>

namespace obscura {

// Where nodes of a checked file stand, and what they hold besides meshes, in world space. A node's
// scale moves neither a camera's angle nor a light's range.

// A node's own transform.
glm::dmat4 transformOf(const tinygltf::Node& node);

// Where the node shows its mesh: once, or as often as EXT_mesh_gpu_instancing says.
std::vector<glm::dmat4> instancesOf(const GltfFile& file, const tinygltf::Model& model,
                                    std::size_t node, const glm::dmat4& worldFromNode);

// The node's perspective camera. Null where it has none, and where it looks nowhere (faultOf()).
// It looks at `ahead`'s distance, or one metre where that lies behind it.
std::optional<NamedCamera> cameraOf(const nlohmann::json& root, std::size_t node,
                                    const glm::dmat4& worldFromNode, const glm::dvec3& ahead);

// The node's light (KHR_lights_punctual); null where it has none.
std::optional<PointLight> lightOf(const nlohmann::json& root, std::size_t node,
                                  const glm::dmat4& worldFromNode);

} // namespace obscura
