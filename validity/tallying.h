#pragma once

#include "validity/truths.h"

#include <cstdint>
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
    bool operator==(const Rate&) const = default;
};
struct Outcomes {
    std::map<std::string, Rate> rejected; // p < .05, by test
    std::map<std::string, Rate> covered;  // 95 % intervals that hold the truth
    Rate anyClaim;                        // some difference claimed after Holm, where there is none
    std::map<std::string, Rate> supported; // by claim, after Holm

    void add(const Outcomes& more); // of other studies of the same world
    bool operator==(const Outcomes&) const = default;
};

// Some of a world's studies, which are numbered from 0.
struct Block {
    int first = 0, studies = 0;
};

// Simulates, writes each study's CSV into `folder` (best in memory, such as /dev/shm), reads it as
// the analysis does, and tests. Study i is the same on every machine, in every block and with any
// number of threads.
Outcomes outcomesOf(const StudySimulator& simulator, const World& world, Block block,
                    std::uint64_t seed, const std::string& folder, int threads = 0);

// The tables of all worlds in Markdown. `planned`: of each claim, the power that obscura-analysis
// plan says for the world "effect".
std::string validityPage(const std::vector<World>& worlds, const std::vector<Outcomes>& outcomes,
                         const std::map<std::string, double>& planned, int studies,
                         std::uint64_t seed);

} // namespace obscura
