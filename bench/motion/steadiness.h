#pragma once

#include "bench/measure/measured_view.h"
#include "bench/motion/shots.h"

#include <filesystem>

namespace obscura {

// Measures of what a still picture does not show, for configurations as they are matched. They take
// long, so choose() asks for them only where every other limit is met. Pictures go into `folder`.

// Of each configuration, the 99th percentile of reference-relative change on the worst of a few
// short camera paths that start at the view (temporal.h, quick effort).
std::vector<double> flickerOf(const Scene& scene, const View& view,
                              const std::vector<NamedSettings>& matched,
                              const std::filesystem::path& folder);

// Which of the failure tests `wanted` (ids of bench/stability/stability.h) the settings do not
// pass, in words, with their numbers. An unknown id is an Error that lists those there are.
std::string failuresOf(const Settings& matched, const std::vector<std::string>& wanted,
                       const std::filesystem::path& folder);

} // namespace obscura
