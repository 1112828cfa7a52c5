#pragma once

#include "base/markup.h"

#include <string>
#include <string_view>

namespace obscura {

// <name>text</name>, the text escaped, and a line feed.
std::string element(std::string_view name, std::string_view text);

// The beginning of a page, <body> included, that can load nothing from elsewhere; in the style that
// all our pages have, with more of its own after it. Only a `scripted` page may hold scripts.
std::string pageHead(std::string_view title, std::string_view style, bool scripted = false);

// A `data:` address that holds the bytes themselves.
std::string dataAddress(std::string_view mediaType, std::string_view bytes);

} // namespace obscura
