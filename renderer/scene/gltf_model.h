#pragma once

#include "renderer/scene/gltf_file.h"

#include <tiny_gltf.h>

namespace obscura {

// The structure of a checked file as tinygltf reads it. Buffers, images and everything that is not
// shown are ours or nobody's, so that it opens no file and trusts no length.
tinygltf::Model modelOf(const GltfFile& file);

} // namespace obscura
