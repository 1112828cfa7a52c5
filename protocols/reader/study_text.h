#pragma once

#include "protocols/reader/study.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace obscura {

// Parts of a study as TOML, the other way round from study_parts.h: what is written here reads back
// as the same values, and looks as a person would write it. Programs that write studies put their
// files together of these.

// The keys of a table with their values as TOML spells them, in the order in which people write
// them. What has its default is left out.
using TomlFields = std::vector<std::pair<std::string, std::string>>;

// On one line: what a study has behind "camera =".
std::string toToml(const Camera& camera);
TomlFields fieldsOf(const View& view); // without its radius where that is 0: a sweep has `radii`
TomlFields fieldsOf(const Level& level);
// Numbers are the shortest that read back as the same float, for a technique has floats. What is
// named in `flags` is true or false.
TomlFields fieldsOf(const TechniqueSetting& technique, const std::vector<std::string>& flags = {});

std::string tomlText(std::string_view text); // in quotes
std::string tomlKey(std::string_view name);  // in quotes where it must be
std::string tomlNumber(double value);        // the shortest that reads back as the same
std::string tomlTriple(const Vec3& values);  // [1, 0.5, 0]
// ["a", "b"]
std::string tomlList(const std::vector<std::string>& texts);

// "[scenes.atrium]" and a line for each key; "{ key = value, ... }" on one line.
std::string tomlTable(std::string_view parent, std::string_view name, const TomlFields& fields);
std::string tomlInline(const TomlFields& fields);
std::string tomlLines(const TomlFields& fields);

} // namespace obscura
