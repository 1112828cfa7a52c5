#pragma once

#include "bench/measure/measured_view.h"
#include "bench/motion/shots.h"

#include <filesystem>

namespace obscura {

// What a still picture does not show, of one configuration as it is matched: choose() asks only of
// those that have met every other limit. Pictures go into `folder`.

// Of each configuration, the 99th percentile of reference-relative change on the worst of a few
// short camera paths that start at the view (temporal.h, quick effort).
std::vector<double> flickerOf(const Scene& scene, const View& view,
                              const std::vector<NamedSettings>& matched,
                              const std::filesystem::path& folder);

// Those of the failure tests `wanted` (ids of stability.h) that go beyond what is no failure, with
// their numbers, as words; an unknown id is an Error that lists them.
std::string failuresOf(const Settings& matched, const std::vector<std::string>& wanted,
                       const std::filesystem::path& folder);

} // namespace obscura
