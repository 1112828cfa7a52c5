#pragma once

#include "gl/context.h"
#include "matching/match_row.h"
#include "protocols/reader/match.h"
#include "renderer/render.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace obscura {

// Called now and then: how much is done, of how much (about seconds), and what is at hand.
using MatchProgress = std::function<void(double done, double total, const std::string& note)>;

// Fits every technique of a study on its training views, and measures raw and fitted settings on
// all. References come from `cache` (renderer/reference/reference_cache.h). Each technique's result
// is kept in `folder`/finished as soon as there is one, and taken from there when all that it
// depends on is the same. Writes `folder`/matched.toml, match.csv and, last, match.png or pages of
// it. Errors are of renderings with the very numbers that the fragment gives.
MatchResult match(const MatchStudy& study, const Folders& folders,
                  const std::filesystem::path& folder, const std::filesystem::path& cache,
                  const gl::Driver& driver, const MatchProgress& progress);

// Hash of our code that fits and measures (code_hash.cmake); what it renders with has its own.
std::string_view matchingCode();

} // namespace obscura
