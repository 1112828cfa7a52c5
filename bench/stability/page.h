#pragma once

#include "bench/stability/cell.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// stability.html: one page that needs nothing else. A heat map of configurations and tests with
// the headline in every cell; picking one shows what is behind it. Below, for each test, its set-up
// and a strip of everybody's pictures, the truth's first (the cells of the configuration "truth").
// Pictures are read from the folder; a missing one is an Error, unless the folder has none of them.
// `about` stands at the end as it is.
std::string stabilityHtml(std::span<const StabilityTest> tests,
                          const std::vector<StabilityCell>& cells,
                          const std::filesystem::path& folder, const std::string& about);

// The configuration under which a test's truth has its picture; it is no technique.
inline constexpr const char* truthName = "truth";

} // namespace obscura
