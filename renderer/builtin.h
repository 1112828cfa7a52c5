#pragma once

#include "renderer/scene.h"

#include <span>
#include <string>
#include <string_view>

namespace obscura {

// Scenes made in code, so that a study runs with no download: "sculpture" (one object with deep
// concavities), "atrium" (two colonnaded storeys, arches, steps, drapery, vases) and "figures"
// (a pair of figures whose base colour carries painted-in occlusion). Metres, y up.
std::span<const std::string> builtinSceneNames();

// An unknown name is an Error that gives the nearest.
Scene builtinScene(std::string_view name);

} // namespace obscura
