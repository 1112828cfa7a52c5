#pragma once

#include <filesystem>
#include <string_view>

namespace obscura {

// A file or folder that comes with the programs and that they read while they run: "shaders",
// "protocols/demo.toml". It lies in ../share/obscura, as seen from the folder of the program that
// runs, be that /usr, a prefix of somebody's own or a build folder (installed.cmake); so nothing
// depends on where one is. Absolute. An Error where it is missing.
std::filesystem::path shipped(std::string_view name);

} // namespace obscura
