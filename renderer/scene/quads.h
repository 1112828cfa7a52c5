#pragma once

#include "renderer/scene/scene.h"

#include <array>

namespace obscura {

// Scenes of one plain material, put together from flat pieces: those that closed forms and failure
// tests are about.

// Corners are counter-clockwise seen from the front.
void addQuad(Scene& scene, const std::array<glm::vec3, 4>& corners);

// Six quads that face outwards.
void addBox(Scene& scene, glm::vec3 low, glm::vec3 high);

} // namespace obscura
