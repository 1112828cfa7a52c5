#pragma once

#include "protocols/reader/study_text.h"

#include <string>
#include <vector>

namespace obscura {

// A table that a TOML file is to get. With a name, [parent.name]; without one, a further entry of
// the list [[parent]].
struct NewTable {
    std::string parent, name;
    TomlFields fields;
};

// The text with these tables in it and everything else as a person wrote it: comments, blank lines,
// line ends. Each follows the last of its kind and is written as that is, be it under a heading or
// on one line; one whose kind the file does not have comes last. `file` is the name that errors
// give: a text that is no TOML, or a parent that is itself written on one line, which nothing can
// be added to. Whether the result is a study is the caller's to check.
std::string withTables(std::string text, const std::string& file,
                       const std::vector<NewTable>& tables);

} // namespace obscura
