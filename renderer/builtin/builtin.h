#pragma once

#include "renderer/scene/scene.h"

#include <span>
#include <string>
#include <string_view>

namespace obscura {

// Scenes made in code, so that a study runs with no download: "sculpture" (one object with deep
// concavities), "atrium" (two colonnaded storeys, arches, steps, drapery, vases), "figures" (a pair
// of figures whose base colour carries painted-in occlusion), "room" (furnished: thin legs, open
// shelves, clutter) and "garden" (leaves cut out by alpha, blades of grass, thin bars); no setting
// of any technique was tuned on the last two. Metres, y up.
std::span<const std::string> builtinSceneNames();

// An unknown name is an Error that gives the nearest. Its sha256 is contentSha256().
Scene builtinScene(std::string_view name);

// SHA-256 of all of a scene that decides pixels: whatever code made it, equal scenes have equal
// hashes. Names of materials and the scene's cameras are no part of it.
std::string contentSha256(const Scene& scene);

} // namespace obscura
