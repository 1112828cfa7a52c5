#pragma once

#include "protocols/reader/study.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// A study of techniques, not of people: which techniques `obscura-stimuli match` fits, on which
// views, to what. docs/protocols.md has each key. Files of this kind share tables with protocols
// (study_parts.h); a protocol takes the result by `include`.

// What techniques are compared with: integrals of renderer/reference/reference.h over the whole
// scene, or the first of them over the depth buffer alone, whose surfaces are as thick as the
// radius.
enum class Truth { cosine, uniform, falloff, depth };

// Their spellings, in the order of the enumeration.
const std::vector<std::string>& truthNames();

struct ImageSize {
    int width = 1280, height = 720;
};

struct MatchStudy {
    std::string name;
    std::uint64_t seed = 0;
    ImageSize image;    // of test views
    ImageSize training; // of training views; the same unless given
    Normals normals = Normals::smooth;
    int rays = 256;              // per pixel of a truth
    Truth truth = Truth::cosine; // what is fitted to, unless there is a
    std::string partner;         // one of `techniques`, whose settings stay as they are
    std::vector<Truth> scores;   // truths that errors are given against too
    std::vector<View> train;     // at each radius
    std::vector<View> test;      // the same; no camera is in both
    std::vector<TechniqueSetting> techniques;

    std::string sha256; // of the file's bytes, and of those of files it includes
};

// `file` is the name that errors give, and its folder the one that `include` starts from.
MatchStudy parseMatchStudy(const std::string& text, const std::string& file);
MatchStudy readMatchStudy(const std::filesystem::path& path);

// The same study of one of its radii alone; another radius is an Error that names those it has.
MatchStudy atRadius(MatchStudy study, double radius);

} // namespace obscura
