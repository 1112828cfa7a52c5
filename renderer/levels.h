#pragma once

#include "protocols/reader/study.h"

#include <span>
#include <string>

namespace obscura {

// The light that programs offer where no protocol says it, in the thesis' three levels of
// complexity: "low" (constant ambient light alone), "moderate" (a sky), "high" (sky and sun).
std::span<const std::string> levelNames();
Level levelNamed(const std::string& name); // one of them; another is an Error

} // namespace obscura
