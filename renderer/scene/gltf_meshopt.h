#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace obscura {

// The bytes of a buffer view that is compressed by EXT_meshopt_compression: `packed` is the
// extension's object, checked (gltf_check.h), and `bytes` are those that it names. Nothing where
// they are no such stream. What comes out has the declared size, and its numbers may be any.
std::optional<std::string> decodeMeshopt(const nlohmann::json& packed,
                                         std::span<const std::byte> bytes);

} // namespace obscura
