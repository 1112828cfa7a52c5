#pragma once

#include "protocols/reader/manifest.h"
#include "renderer/render.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace obscura {

struct GenerateResult {
    Manifest manifest;
    int rendered = 0, kept = 0; // images: by this process; those that it found, or others rendered
    StageTimes times;           // of those rendered
    // What the scenes that were loaded use and we do not show, and what makes images worthless
    // (stimuli/warnings.h), of every condition rendered since this run began, whoever did; what an
    // earlier run's manifest lacks, for which its images are made anew.
    std::vector<std::string> warnings;
    double writing = 0;   // seconds: encoding and flushing files, and the contact sheet
    double measuring = 0; // seconds: references, errors, predictions and times
};

// Called before each image with how many are done, by whichever process, of how many, and its file
// name; or what is waited for.
using Announce = std::function<void(int done, int total, const std::string& file)>;

// Carries out a protocol's plan into `folder`: a PNG per image and one of its visibility,
// with `layers` also linear EXRs ("linear", "visibility", "albedo", "depth", "normal"); then the
// contact sheet, contact-sheet.png or pages of it; last manifest.json. An image is kept when the
// manifest of an earlier run, or a condition that an interrupted one had finished, proves that the
// same recipe made the very bytes on disk, those of its layers included; an image that has EXRs
// keeps having them, also when it is made anew. The members of a pair must have equal inputs before
// occlusion, or nothing is published: an Error. `code` is the hash of what renders.
//
// Processes that do the same in one folder at the same time share the work (base/units.h): a unit
// is a condition, then the times of all techniques, which one process measures while the others
// wait, then contact sheet and manifest. But for times, every file is what one process would have
// written.
GenerateResult generate(const Protocol& protocol, const Folders& folders,
                        const std::filesystem::path& folder, bool layers, const gl::Driver& driver,
                        const Announce& announce, std::string_view code = imageCode());

// All that generate() meets before it draws: loads every scene and environment image onto the GPU,
// and compiles the shaders. What is wrong is an Error with the protocol's line. Gives the warnings
// that generate() would, of scenes and of conditions that are worth nothing (stimuli/warnings.h).
std::vector<std::string> check(const Protocol& protocol, const Folders& folders,
                               const gl::Driver& driver, const Announce& announce);

// Whether the folder holds what the protocol asks for, byte for byte. First that each condition was
// made by the recipe that the protocol gives today, and that each file (images, layers, contact
// sheet) has the recorded hash; then every image is rendered again and compared, with its layers.
// The first thing that differs is an Error that says what, and generate() mends it. Returns the
// number of images that other code made, and that come out the same.
int verify(const Protocol& protocol, const Manifest& manifest, const Folders& folders,
           const gl::Driver& driver, const Announce& announce, std::string_view code = imageCode());

} // namespace obscura
