#pragma once

#include <map>
#include <string>
#include <vector>

namespace obscura {

// What selection.h chooses, and what it goes by.

struct PlannedTrial {
    enum class Kind { practice, main, catchTrial, rest };

    Kind kind = Kind::main;
    int condition = -1;          // as the protocol counts them, from 0; -1 for a break
    std::vector<int> roles = {}; // roles[place] = index into the trial's ordered roles; {0, 1}
                                 // shows a first, {1, 0} b; empty for a break
    int repeat = 1;              // which presentation of this condition to this participant
    int block = 1;               // that the trial belongs to, in the order of this participant

    bool reversed() const { return roles == std::vector<int>{1, 0}; } // of pairs: b is first
    bool operator==(const PlannedTrial&) const = default;
};

// A trial that was shown. An interrupted one is not shown again, since nothing can be unseen; but
// its answer counts for nothing where answers decide the order.
struct PastTrial {
    PlannedTrial trial;
    std::map<std::string, std::string> answers; // by name, as in the protocol's `answer`
    bool interrupted = false;
};

} // namespace obscura
