#pragma once

#include "protocols/reader/study.h"

#include <glm/glm.hpp>

namespace obscura {

// What a protocol says of a place or a direction, as renderers reckon with it.
inline glm::dvec3 vec(const Vec3& v) { return {v[0], v[1], v[2]}; }
inline Vec3 arrayOf(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

} // namespace obscura
