#pragma once

#include <string_view>

namespace obscura {

// Hashes of our own C++ (code_hash.cmake), for what other code made may look otherwise. Shaders and
// built-in scenes are not part of them: those have hashes of their own (shaderSha256(),
// contentSha256()), so that a changed one is rendered anew alone.

std::string_view imageCode();     // that decides the pixels of an image
std::string_view referenceCode(); // that decides a reference's; techniques are no part of it

} // namespace obscura
