#pragma once

#include <string>
#include <string_view>

namespace obscura {

// Text that stands for itself in HTML, SVG and Pango's markup, between tags and in quotes.
std::string escaped(std::string_view text);

} // namespace obscura
