#pragma once

#include "validity/simulated_study.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// The protocol of all simulated studies: seven conditions at three levels of one scene, 28 people,
// Williams' order, claims of each kind in one family. The masks are short: nothing depends on them.
Protocol validityProtocol();

// A state of the world.
struct World {
    std::string_view name, words;
    Truth truth;
    // Of each test by its name in the table (tallying.h): whether what it tests is so.
    std::function<bool(const std::string&)> isNull;
};
std::vector<World> worlds();

} // namespace obscura
