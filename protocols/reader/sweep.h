#pragma once

#include "protocols/reader/display.h"
#include "protocols/reader/match.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// What `obscura-bench sweep` and `choose` measure: techniques with lists of settings, each
// combination a configuration, on views of several sizes. docs/protocols.md has each key. Files of
// this kind have all that a match study has but [image], and lists among the techniques' settings.

// How cost grows, one thing at a time.
struct GrowthPlan {
    std::string view;                         // name of one of the study's
    std::vector<double> radii;                // metres
    std::vector<ImageSize> sizes;             // the first is that of all other axes
    std::vector<int> poles;                   // thin poles before a wall: depth complexity
    std::vector<TechniqueSetting> techniques; // each technique's values of the setting that counts
                                              // its samples, in order; the middle one stands for it
                                              // on the other axes
};

struct SweepStudy {
    MatchStudy match; // every configuration; training views fit, test views are measured
    std::vector<ImageSize> sizes;
    std::optional<Level> light;           // of lit images; without it there are none
    Display display = displays().front(); // on which a person would see them
    int frames = 200;                     // timed of each configuration, or as many as fit in
    double seconds = 5;
    std::optional<GrowthPlan> growth;
};

SweepStudy parseSweepStudy(const std::string& text, const std::string& file);
SweepStudy readSweepStudy(const std::filesystem::path& path);

// The same in a few minutes: one training view and the first few test views at a small size, few
// rays, little timing. For a first look, not for figures.
SweepStudy quick(SweepStudy study, std::size_t testViews);

// The name of the technique that a configuration varies: up to the first space.
std::string variedName(const std::string& configuration);

} // namespace obscura
