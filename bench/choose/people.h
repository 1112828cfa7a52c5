#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// A limit on predicted JOD from people's answers: `obscura-bench choose --people FOLDER`.

// One technique in one scene and level of a ladder study, as obscura-analysis writes it into
// ladder.csv.
struct PeopleRung {
    std::string scene, level, technique, name;
    double milliseconds = 0;              // NaN: not measured
    double people = 0, low = 0, high = 0; // JOD of people, relative to `ray_traced`, and its 95 %
                                          // interval, perhaps endless; below 0: worse
    double predicted = 0;                 // JOD: 10 of what does not differ; NaN: not measured
};

// An Error names file, line and column.
std::vector<PeopleRung> readPeople(const std::filesystem::path& folder);

// The cheapest rung of each scene and level whose interval reaches -margin: people are not known to
// see it as worse than the ray-traced image by more. Its predicted JOD is enough there; the limit
// is the highest of these, and so enough in each.
struct PeopleLimit {
    double jod = 0;
    std::string words; // a line for each scene and level
};
PeopleLimit limitOf(const std::vector<PeopleRung>& rungs, double margin);

} // namespace obscura
