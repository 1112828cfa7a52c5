#pragma once

#include "protocols/reader/protocol.h"

#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// What a protocol says, in three parts, each as JSON with sorted keys and without white space, so
// that equal contents are equal texts and have equal hashes. Every field of a protocol is in
// exactly one of them; where it stands in the file, comments and spelling are in none. The keys are
// the protocol's own.
struct ProtocolParts {
    std::string stimuli;   // what the pictures and their labels depend on: scenes, levels and
                           // techniques that conditions use, the conditions, image size, seed
    std::string procedure; // what else decides what participants see and do: the order, the trial
    std::string texts;     // the rest: words, title, planned number, the simulated observer, the
                           // display that differences are predicted on, and scenes, levels and
                           // techniques that no condition uses
};
ProtocolParts partsOf(const Protocol& protocol);

// All that must stay as it is while a study runs: the parts `stimuli` and `procedure` as one
// object.
std::string designOf(const Protocol& protocol);

// How one such text became another: "trial.mask was 2, is now 3", the same for each value.
std::vector<std::string> differences(std::string_view before, std::string_view now);

} // namespace obscura
