#pragma once

#include "protocols/reader/manifest.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace obscura {

// By what a study was made: `archive`, the program that made the archive, with the libraries that
// it was built with, system and processor; `stimuli`, each program, code and OpenGL that rendered,
// and the processor; `presenter`, each program, machine and system that participants sat before.
nlohmann::ordered_json thisMachine(); // what would stand under `archive`
nlohmann::ordered_json versionsOf(const Manifest& manifest, const std::filesystem::path& data);

} // namespace obscura
