#pragma once

#include "bench/stability/cell.h"
#include "bench/stability/motion.h"
#include "protocols/reader/match.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// `obscura-bench stability`: techniques through every failure test. The folder gets stability.csv
// (csv.h), stability.json, pictures/TEST-CONFIGURATION.png and stability.html (page.h).

struct StabilityOptions {
    std::vector<std::string> configurations; // as bench/measure/tested_technique.h takes them
    std::filesystem::path folder;
    ImageSize size{320, 180};       // of the tests' images; some derive theirs from it
    std::vector<std::string> tests; // of still pictures, by id; those in motion have their own list
    std::optional<Motion> motion = {};
    std::string about =
        "{}\n";        // stability.json: what else decides the numbers, such as the program
    bool anew = false; // whatever the folder's CSV holds is left out
};

// All tests of still pictures, in the order of the page's columns; those in motion
// (bench/motion/temporal.h) follow them.
std::vector<StabilityTest> stabilityTests();
std::vector<std::string> stillTestIds();
// The defaults of every technique of the table that sees only the screen.
std::vector<std::string> screenTechniques();

// The share done, 0 ... 1, and what is at hand.
using StabilityProgress = std::function<void(double, const std::string&)>;

// Runs the tests, with all other processes that do so in this folder (base/units.h); what was done
// there with the same `about` and size is not done again while its pictures are there. CSV and page
// are made at the end, by one of them, and are those of a process alone. What the folder's CSV
// holds of other tests and configurations stays, if it was measured with the same `about`. If it
// was measured with another, that is an Error, unless `anew` is set. A context must be current; an
// unknown test is an Error. Returns all that stands in the CSV.
std::vector<StabilityCell> runStability(const StabilityOptions& options,
                                        const StabilityProgress& progress);

// Makes the page anew from the folder's CSV and pictures.
void writeStabilityPage(const std::filesystem::path& folder);

} // namespace obscura
