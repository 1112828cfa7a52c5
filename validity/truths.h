#pragma once

#include "validity/simulated_study.h"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// The protocol of most simulated studies: seven conditions at three levels of one scene, 28 people,
// Williams' order, claims of each kind in one family. The masks are short: nothing depends on them.
Protocol validityProtocol();

// Two levels, each answered twice.
Protocol repeatedProtocol();

// All pairs of four techniques, for a scale.
Protocol ladderProtocol();

// A state of the world.
struct World {
    std::string_view name, words;
    Truth truth;
    // Of each test by its name in the table (tallying.h): whether what it tests is so.
    std::function<bool(const std::string&)> isNull;
    Protocol (*protocol)() = validityProtocol;
    int people = 28;
    int fewer = 1;                  // studies are so many times fewer: scales take long
    std::vector<double> scale = {}; // JOD of each technique; empty: no scale is asked for

    int studies(int asked) const { return std::max(1, asked / fewer); }
};
std::vector<World> worlds();

} // namespace obscura
