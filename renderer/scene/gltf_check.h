#pragma once

#include "renderer/scene/gltf_json.h"

#include <filesystem>

namespace obscura {

// The one place where a glTF file's JSON is trusted or not (glTF 2.0 specification, chapters 3 and
// 5): every index points into its array; every count, offset, length and stride is a whole number
// of a sensible size, and what they describe lies within its buffer view, and that within its
// buffer's declared length; numbers are finite; names of types and modes are known; required
// extensions are ones that we show. What is wrong is an Error with file, JSON path, expected and
// found. Whether the buffers are as long as they declare is checked where they are read
// (gltf_file.h), and what they contain where it is used.
void checkGltf(const nlohmann::json& root, const std::filesystem::path& file);

} // namespace obscura
