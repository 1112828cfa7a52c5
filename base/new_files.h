#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

namespace obscura {

// A file that is to be made: of a text, or as a copy of another file.
struct NewFile {
    std::string text;
    std::filesystem::path copyOf = {}; // "": of the text

    bool operator==(const NewFile&) const = default;
};
using NewFiles = std::map<std::string, NewFile>; // by path within their folder

// An Error where the path is that of a file, or of a folder with something in it.
void checkIsFree(const std::filesystem::path& path);

// Makes a file or a folder, whole or not at all. `make` is given a path in a hidden folder beside
// `path`, and what it has made there gets that name when it returns. Nothing that was there before
// is changed: it must be free.
void makeNew(const std::filesystem::path& path,
             const std::function<void(const std::filesystem::path&)>& make);

// A new folder of these files; in memory is one of them at a time.
void writeFiles(const std::filesystem::path& folder, const NewFiles& files);

} // namespace obscura
