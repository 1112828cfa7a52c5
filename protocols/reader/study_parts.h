#pragma once

#include "protocols/reader/study.h"
#include "protocols/reader/toml_table.h"

#include <algorithm>

namespace obscura {

// What files of several kinds have in common: a study of people (protocol.h) and a study of
// techniques (match.h) declare scenes and techniques alike.

// [scenes.NAME]; without `withRadius` the key `radius` is unknown there.
View parseView(const std::string& name, TomlTable table, bool withRadius = true);

// [techniques.NAME]. Which settings exist, and their ranges, the renderer's technique table knows;
// here they must be numbers, or true and false for 1 and 0.
TechniqueSetting parseTechnique(const std::string& name, TomlTable table);

// The same with lists where one value is expected (`steps = [2, 4, 8]`, `preset = ["low",
// "high"]`): every combination, keys in alphabetical order, each named "NAME steps=2
// preset=low" by what the lists give it.
std::vector<TechniqueSetting> parseVariants(const std::string& name, TomlTable table);

// All techniques of a study: those of the files that its `include` names (relative to the study's
// folder), then its own. No two may have the same name.
struct Techniques {
    std::vector<TechniqueSetting> techniques;
    std::vector<std::string> includes; // those files, as the study names them
    std::string includedSha256;        // of each included file, one after the other
};
enum class Lists { refused, varied };
Techniques parseTechniques(TomlTable& root, Lists lists = Lists::refused);

// [levels.NAME], or another table of that kind.
Level parseLevel(const std::string& name, TomlTable table);

// What a study of techniques compares, on which views and with which truth: all of match.h but the
// image's size.
struct MatchStudy;
MatchStudy parseComparison(TomlTable& root, Lists lists, std::string& includedSha256);
struct ImageSize;
ImageSize parseSize(TomlTable table);

// The hash of a study's text and of what it includes; of the text alone where it includes nothing.
std::string studySha256(const std::string& text, const std::string& includedSha256);

Normals parseNormals(TomlTable& root);

// The key `name` is to be lower-case letters, digits and `alsoAllowed`, which an error calls
// `spelt`.
void checkName(const TomlTable& table, std::string_view key, const std::string& name,
               std::string_view alsoAllowed, std::string_view spelt);

// What is not TOML is an Error with line and column.
toml::table parseToml(const std::string& text, const std::string& file);

template <typename T>
std::vector<std::string> names(const std::vector<T>& items) {
    std::vector<std::string> result;
    for (const T& item : items)
        result.push_back(item.name);
    return result;
}

// The name given at `place` must be one of `items`, which an error calls `kind`.
template <typename T>
void mustExist(const Place& place, const std::string& name, const std::vector<T>& items,
               std::string_view kind) {
    const auto known = names(items);
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error(place, "expected the name of " + std::string(kind) + ", found \"" + name +
                               "\"" + suggestion(name, known));
}

} // namespace obscura
