#pragma once

#include "renderer/scene/gltf_json.h"

namespace obscura {

// Images, samplers, textures and materials, as part of checkGltf().
void checkGltfMaterials(const GltfJson& values);

} // namespace obscura
