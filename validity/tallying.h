#pragma once

#include "validity/truths.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace obscura {

// What came of many studies of one world.
struct Rate {
    int hits = 0, of = 0;
    void add(bool hit) {
        hits += hit;
        ++of;
    }
};
struct Outcomes {
    std::map<std::string, Rate> rejected; // p < .05, by test
    std::map<std::string, Rate> covered;  // 95 % intervals that hold the truth
    Rate anyClaim;                        // some difference claimed after Holm, where there is none
    std::map<std::string, Rate> supported; // by claim, after Holm
};

// Simulates, writes each study's CSV into `folder` (best in memory, such as /dev/shm), reads it as
// the analysis does, and tests. Study i is the same on every machine and with any number of
// threads.
Outcomes outcomesOf(const StudySimulator& simulator, const World& world, int studies,
                    std::uint64_t seed, const std::string& folder, int threads = 0,
                    const std::function<void(double)>& progress = {});

// The tables of all worlds in Markdown. `planned`: of each claim, the power that obscura-analysis
// plan says for the world "effect".
std::string validityPage(const std::vector<World>& worlds, const std::vector<Outcomes>& outcomes,
                         const std::map<std::string, double>& planned, int studies,
                         std::uint64_t seed);

} // namespace obscura
