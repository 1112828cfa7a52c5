#pragma once

#include "renderer/scene/gltf_json.h"

#include <string>
#include <vector>

namespace obscura {

// The lists of extensions, as part of checkGltf(). An Error names every extension that the file
// requires and we do not show, what the picture would lack, and what to do.
void checkGltfExtensions(const GltfJson& values);

// A sentence for each extension that a checked file uses, declared or not, and we leave out: what
// the picture lacks.
std::vector<std::string> extensionsLeftOut(const nlohmann::json& root);

} // namespace obscura
