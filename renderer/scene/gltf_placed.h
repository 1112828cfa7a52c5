#pragma once

#include "renderer/scene/scene.h"

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace obscura {

// What nodes of a checked file hold besides meshes, in world space. The node's scale moves neither
// a camera's angle nor a light's range.

// The node's perspective camera. Null where it has none, and where it looks nowhere (faultOf()).
// It looks at `ahead`'s distance, or one metre where that lies behind it.
std::optional<NamedCamera> cameraOf(const nlohmann::json& root, std::size_t node,
                                    const glm::dmat4& worldFromNode, const glm::dvec3& ahead);

// The node's light (KHR_lights_punctual); null where it has none.
std::optional<PointLight> lightOf(const nlohmann::json& root, std::size_t node,
                                  const glm::dmat4& worldFromNode);

} // namespace obscura
