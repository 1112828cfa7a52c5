#pragma once

#include "renderer/builtin/shapes.h"

#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace obscura::builtin {

// Gives a welded shape texture coordinates in which no two places share a texel, as a game artist
// unwraps a character: patches that face one of the six axes are laid side by side. `part` names
// the part of the body that each vertex belongs to; patches do not cross between parts, so that an
// arm does not fall on the breast behind it. `density`: how much larger each part is laid out.
// Vertices on a patch's edge are doubled; the result says which vertex each one was.
std::vector<std::uint32_t> unwrap(Shape& shape, const std::vector<int>& part,
                                  const std::vector<float>& density);

// Paints every texel that a triangle covers, and a border round each patch so that filtering finds
// no gaps. `colour` takes a triangle's corners and the weights of the place between them.
using Brush = std::function<glm::vec3(const std::array<std::uint32_t, 3>&, glm::vec3)>;
Image8 paintAtlas(const Shape& shape, int size, const Brush& colour);

} // namespace obscura::builtin
