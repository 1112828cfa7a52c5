#pragma once

#include "protocols/reader/manifest.h"

#include <filesystem>
#include <string>

namespace obscura {

// What writeManifest() writes and readManifest() reads, where it is not a file of its own. `path` is
// for errors, and its folder the manifest's.
std::string manifestText(const Manifest& manifest);
Manifest parseManifest(const std::string& text, const std::filesystem::path& path);

} // namespace obscura
