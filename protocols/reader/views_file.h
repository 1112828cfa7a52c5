#pragma once

#include "protocols/reader/study.h"

#include <string>
#include <vector>

namespace obscura {

// A file of views alone: [scenes.NAME] tables as a study has them, in the order of the file, so
// that a person can copy one into a protocol.

// `file` is named in errors, which give line, column and key. Other tables are errors; an empty
// file has no views.
std::vector<View> parseViews(const std::string& text, const std::string& file);

// Reads back as the same views. `comment` stands above, each line behind "# ".
std::string viewsText(const std::vector<View>& views, const std::string& comment);

} // namespace obscura
