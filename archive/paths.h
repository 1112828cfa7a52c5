#pragma once

#include <string>
#include <string_view>

namespace obscura {

// Archives come from anybody. What is wrong with the name of a file within one, wherever it stands
// (zip, checksums, manifest): "" for a plain relative path that stays below its folder on every
// system, such as "stimuli/a.png".
std::string faultOfPath(std::string_view path);

} // namespace obscura
