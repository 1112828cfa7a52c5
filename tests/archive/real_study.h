#pragma once

#include "archive/check.h"
#include "archive/study.h"

#include <filesystem>
#include <string>

namespace obscura::test {

// A study in small, through everything: rendered stimuli, simulated participants, their answers
// analysed. Made once for all tests of a program, and never changed.
struct RealStudy {
    std::filesystem::path root; // with scenes/, p/tiny.toml, stimuli/, data/tiny/, results/
    StudyPlaces places;
    std::filesystem::path scenes; // what OBSCURA_SCENES would be
};
const RealStudy& realStudy();

// The parts elsewhere, to be changed.
StudyPlaces copied(const std::filesystem::path& to);

// As obscura-archive makes it: a folder, or a zip where the name says so.
void archived(const StudyPlaces& places, const std::filesystem::path& out, bool withScenes = false);

std::vector<Checked> checked(const std::filesystem::path& archive,
                             const std::filesystem::path& scenes = realStudy().scenes);

// SHA256SUMS anew, as whoever changes an archive on purpose would do.
void renewSums(const std::filesystem::path& archive);

// In a text file; the test fails where there is no such text.
void replaceIn(const std::filesystem::path& file, const std::string& what, const std::string& by);

} // namespace obscura::test
