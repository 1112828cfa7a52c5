#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

struct WorkUnit {
    std::string name;  // unique; any text
    std::string group; // units of a group share what is slow to prepare, such as a view of a scene
    double cost = 1;   // about how long it takes, in any measure that all units share
};

// What is known of a folder's units: by those who work, and by `obscura-bench status`.
struct UnitsState {
    struct Held {
        std::string name, machine; // of the claim that counts
        long pid = 0;
        double seconds = 0; // since it was claimed
    };

    std::size_t units = 0, done = 0;
    double cost = 0, costDone = 0;
    std::vector<Held> held;          // by processes that live, as far as one can tell
    std::vector<std::string> broken; // claims whose process ended or whose lease ran out
    // Of all workers together, by what was finished in the last while; nothing before two units
    // are done, and of work that nobody does.
    std::optional<double> secondsLeft;
};

} // namespace obscura
