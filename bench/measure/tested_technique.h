#pragma once

#include "renderer/probe.h"

#include <map>
#include <string>
#include <utility>

namespace obscura {

// A technique and its settings as failure tests run it. Its radius is the unit of length: 1 m
// unless a test scales everything. Shaders are compiled once for each size of image.
class TestedTechnique {
  public:
    // `configuration`: a technique's id, and perhaps settings: "hbao", "hbao steps=8 blur=0". It is
    // an Error if the table does not know the technique or a setting, if a radius is given, or if
    // the technique traces the scene's triangles.
    explicit TestedTechnique(const std::string& configuration);

    const std::string& configuration() const { return configuration_; }
    const Settings& settings() const { return settings_; }
    TestedTechnique scaled(double factor) const; // its radius

    // probe.h; `beyond` pixels past each border are rendered for the technique besides.
    Image visibility(const Probe& probe, int beyond = 0) const;
    // The median wall time of so many runs, each to the end and with its result read back.
    double seconds(const Probe& probe, int runs) const;

  private:
    OcclusionPasses& passes(const Probe& probe, int beyond) const;

    std::string configuration_;
    Settings settings_;
    mutable std::map<std::pair<int, int>, OcclusionPasses> passes_; // by size with all borders
};

} // namespace obscura
