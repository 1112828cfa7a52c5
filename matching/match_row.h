#pragma once

#include "metrics/image_error.h"
#include "protocols/reader/match.h"

#include <map>
#include <string>
#include <vector>

namespace obscura {

// What matching finds.

// One line of match.csv: a technique's error on one view.
struct MatchRow {
    std::string technique; // name in the study; of a truth itself, "cosine reference" and so on
    std::string view;
    double radius = 0; // metres
    bool train = false;
    std::string reference; // what it is compared with
    std::string stage;     // "raw" or "matched"
    ImageError error;
};

struct MatchedTechnique {
    TechniqueSetting setting;             // as the study gives it
    std::map<std::string, double> fitted; // settings that were fitted
    std::string note; // why nothing, or not all, was fitted; "" when all is well
    std::vector<MatchRow> rows;
};

struct MatchResult {
    std::vector<MatchedTechnique> techniques;
    std::vector<MatchRow> truths;                   // among each other, on test views
    std::map<std::string, std::string> sceneSha256; // by file or built-in name
    std::vector<std::string> warnings;              // of scenes
    int kept = 0;                                   // techniques known from an earlier run
};

} // namespace obscura
