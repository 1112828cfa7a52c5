#pragma once

#include "protocols/reader/boost.h"
#include "protocols/reader/claims.h"
#include "protocols/reader/display.h"
#include "protocols/reader/keys.h"
#include "protocols/reader/ordering.h"
#include "protocols/reader/screen.h"
#include "protocols/reader/study.h"
#include "protocols/reader/texts.h"
#include "protocols/reader/trial.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// A study as one TOML file says it. parseProtocol() checks everything that needs neither the
// technique table nor a scene file: what it returns has no unknown key, wrong type, value out of
// range, or pair whose members differ in more than the technique. docs/protocols.md has each key.

// How a simulated participant answers; never used for real ones.
struct SimulatedChoice {
    double chooseB = 0.5; // probability of choosing member b, before position bias
};

// An image of a condition: what it is there, and the technique that it is rendered with.
struct Role {
    std::string name;      // "a", "b", "reference"; lower-case letters and digits
    std::string technique; // name of one of `techniques`
};

// Images alike in everything but the technique.
struct Condition {
    std::string id;
    std::string view;  // name of one of `views`
    std::string level; // name of one of `levels`
    std::string hypothesis;
    std::vector<Role> roles; // sorted by name; those of a pair are a and b
    SimulatedChoice simulated;
    std::string correct = {}; // the right answer; "" where there is none
    Place place = {};
};

// The stated model of simulated reaction: times are ex-Gaussian (mean and standard deviation of
// the Gaussian part, mean of the exponential part), in seconds.
struct ExGaussian {
    double mean = 0, deviation = 0, tail = 0;
};
struct Simulation {
    double positionBias = 0; // added to the probability of choosing the second image, -0.5 ... 0.5
    double lapse = 0; // of who goes by predicted JOD: share of trials answered at random, 0 ... 1
    ExGaussian view{3.0, 0.8, 2.0};
    ExGaussian decision{0.9, 0.2, 0.5};
};

struct Protocol {
    std::string name; // lower-case letters, digits and hyphens; names the data folder
    std::string title;
    std::uint64_t seed = 0;
    int width = 1280, height = 720;
    int antialiasing = 4; // jittered frames averaged per image
    Normals normals = Normals::smooth;
    std::vector<View> views;
    std::vector<Level> levels;
    std::vector<TechniqueSetting> techniques;
    std::vector<std::string>
        includes; // files with some of these, relative to the protocol's folder
    std::vector<Condition> conditions;
    std::optional<Boost> boost; // nothing: images are shown as they were rendered
    Trial trial;
    std::vector<Phase> before, after; // pages around the trials, each shown once
    Keys keys;
    ScreenNeeds screen;
    Display display; // on which differences between images are predicted
    Ordering ordering;
    std::vector<Claim> claims;
    ExclusionRules exclusions;
    Texts texts;                     // of the first language, or the only one
    std::vector<Texts> translations; // the others, in the order of the file
    Simulation simulation;

    std::filesystem::path path; // where it was read; "" when parsed from text
    std::string sha256;         // of the file's bytes, and of those of files it includes

    // By name; the parser has made sure that those of a condition exist.
    const View& view(const std::string& name) const;
    const Level& level(const std::string& name) const;
    const TechniqueSetting& technique(const std::string& name) const;
    // The texts of every language, at least one.
    std::vector<const Texts*> languages() const;
};

// `file` is the name that errors give. Throws Error with line and column.
Protocol parseProtocol(const std::string& text, const std::string& file);
Protocol readProtocol(const std::filesystem::path& path);

} // namespace obscura
