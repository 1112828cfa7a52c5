#pragma once

#include "viewer/seen.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// From what is on the screen to studies: pairs for people, cameras for a sweep. Texts are functions
// of plain values, and are read back by the studies' own readers before any file is touched. A file
// is written whole or not at all.

// A whole protocol whose only condition is the pair: images of 1280 x 720, two seconds of grey
// between, a choice, a balanced order, English texts. `folder` is where it will lie.
std::string protocolText(const Seen& seen, const std::string& name,
                         const std::filesystem::path& folder);

struct Added {
    std::string text;               // of the whole protocol
    std::string condition;          // its id
    std::vector<std::string> notes; // what the study will show otherwise than the screen does
};

// The protocol `text` with the pair as a further condition. Scenes, levels and techniques that it
// has are used; others get names of their own, and all that a person wrote stays as it is. An Error
// says what clashes: the pair is there already, the trial shows no pair, other normals.
Added withPair(const std::string& text, const std::filesystem::path& file, const Seen& seen);

// The same for a file, or a new one named after it where there is none.
Added addPair(const std::filesystem::path& file, const Seen& seen);

// A study that `obscura-bench sweep` takes: every third camera fits, the others judge, on 960 x
// 540 pixels as in ours. Techniques that trace rays are left out. An Error where fewer than two
// cameras, or no technique, are left.
std::string sweepText(const std::string& name, const std::vector<View>& cameras, const Seen& seen,
                      const std::filesystem::path& folder);
// Writes it; never over a file that is there.
void writeSweep(const std::filesystem::path& file, const std::vector<View>& cameras,
                const Seen& seen);

} // namespace obscura
