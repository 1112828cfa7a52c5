#pragma once

#include <string>
#include <string_view>

namespace obscura {

// Text as it must stand in HTML or XML, in elements and in quoted attributes.
std::string escaped(std::string_view text);

// A `data:` address that holds the bytes themselves.
std::string dataAddress(std::string_view mediaType, std::string_view bytes);

} // namespace obscura
