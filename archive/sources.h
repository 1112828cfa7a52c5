#pragma once

#include "base/new_files.h"
#include "protocols/reader/manifest.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// What a study shows that others made: scenes and environment images. An archive has their names
// and hashes, and themselves only on request, since nobody but their authors can allow that.
struct Source {
    std::string kind;    // "scene", "built-in scene", "environment image"
    std::string name;    // as the protocol has it: of a file, or of a built-in scene
    std::string sha256;  // of all its files; that of the ground which a protocol adds is in it
    std::string licence; // what its files say of it; "" where they say nothing, or are not here
    NewFiles files = {}; // those that lie here, by path within the archive
};

// Of all images of the manifest, each once. Scenes are looked for in `scenes`, environment images
// in the protocol's folder `protocol`, and counted as not being here where their hash is another.
std::vector<Source> sourcesOf(const Manifest& manifest, const std::filesystem::path& scenes,
                              const std::filesystem::path& protocol);

// Where an archive keeps scenes.
constexpr const char* scenesFolder = "stimuli/scenes";

// LICENCES.md: of everything in the archive, what is known and what is not. `own` is what the data
// folder's description says of the study itself, "" for nothing.
std::string licencesText(const std::string& own, const std::vector<Source>& sources);

} // namespace obscura
