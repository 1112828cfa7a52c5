#pragma once

#include "protocols/reader/study.h"
#include "renderer/scene/scene.h"

namespace obscura {

// Adds a floor at the scene's lowest point and a wall, and makes them part of its hash. They reach
// to either side, forward and up by twice the scene's longest side. A wall that is not behind the
// scene is an Error.
void addGround(Scene& scene, const Ground& ground);

// The hash of a scene that has one, of that without.
std::string sha256With(const Ground& ground, const std::string& sceneSha256);

} // namespace obscura
