#pragma once

#include "base/tasks.h"

#include "validity/tallying.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace obscura {

// The simulated studies as units of work (base/units.h): a block of a world's studies is one, and
// so is what is planned for the world "effect".

struct ValidityOptions {
    int studies = 10000; // in each world
    std::uint64_t seed = 1;
    std::filesystem::path share;  // units/ in it has the units; those of other studies are an Error
    std::filesystem::path memory; // where each study's CSV lies while it is read
    int threads = 0;              // of this process; 0: one for each core
    // Studies of a unit, of scales as many fewer as worlds say; 0: a hundredth of all, at least
    // 100, which take a second.
    int block = 0;
    int planned = 2000; // studies for each power that is planned
};

// The page of all worlds (validityPage()). What is done in `share` is not done again; other
// processes with the same options may do the rest at the same time. The page is the same, byte for
// byte, however many they are.
std::string sharedValidityPage(const ValidityOptions& options, const TaskProgress& progress = {});

// Of each claim, the power that is planned for people who choose as those of the world do.
std::map<std::string, double> plannedPower(const World& world, int studies);

// As the result of a unit, and back. What is no such text is an Error.
std::string outcomesText(const Outcomes& outcomes);
Outcomes readOutcomes(const std::string& text);

// Hash of all code that decides what comes of a simulated study (code_hash.cmake).
std::string_view validityCode();

} // namespace obscura
