#pragma once

#include "protocols/manifest.h"
#include "renderer/render.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace obscura {

struct GenerateResult {
    Manifest manifest;
    int rendered = 0, kept = 0;        // images
    StageTimes times;                  // of those rendered
    std::vector<std::string> warnings; // what the scenes that were loaded use and we do not show
    double writing = 0; // seconds: encoding and flushing files, and the contact sheet
};

// Called before each image with how many are done, of how many, and its file name.
using Announce = std::function<void(int done, int total, const std::string& file)>;

// Carries out a protocol's plan into `folder`: a PNG per image and one of its visibility,
// with `layers` also linear EXRs ("linear", "visibility", "albedo", "depth", "normal"); then
// contact-sheet.png; last manifest.json. An image is kept when the manifest of an earlier run, also
// of an interrupted one, proves that the same recipe made the very bytes on disk. The members of a
// pair must have equal inputs before occlusion, or nothing is published: an Error.
GenerateResult generate(const Protocol& protocol, const Folders& folders,
                        const std::filesystem::path& folder, bool layers, const gl::Driver& driver,
                        const Announce& announce);

// Renders every image of a manifest again from its recipe alone and compares the bytes. The first
// that differs, or whose file does not have the recorded hash, is an Error.
void verify(const Manifest& manifest, const Folders& folders, const gl::Driver& driver,
            const Announce& announce);

} // namespace obscura
