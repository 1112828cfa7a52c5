#pragma once

#include <string>

namespace obscura {

// Whether most of a text's letters run from right to left.
bool runsFromRightToLeft(const std::string& text);

} // namespace obscura
