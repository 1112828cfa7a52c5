#pragma once

#include "protocols/match.h"
#include "renderer/gl/context.h"
#include "renderer/image_error.h"
#include "renderer/render.h"
#include "renderer/settings.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

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

// Called now and then: how much is done, of how much (about seconds), and what is at hand.
using MatchProgress = std::function<void(double done, double total, const std::string& note)>;

// Fits every technique of a study on its training views, and measures raw and fitted settings on
// all. References come from `cache` (renderer/reference_cache.h). Each technique's result is kept
// in `folder`/finished as soon as there is one, and taken from there when all that it depends on is
// the same. Writes `folder`/matched.toml, match.csv and match.png last. Errors are of renderings
// with the very numbers that the fragment gives.
MatchResult match(const MatchStudy& study, const Folders& folders,
                  const std::filesystem::path& folder, const std::filesystem::path& cache,
                  const gl::Driver& driver, const MatchProgress& progress);

// Hash of our code that fits and measures (code_hash.cmake); what it renders with has its own.
std::string_view matchingCode();

} // namespace obscura
