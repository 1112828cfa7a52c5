#pragma once

#include "experiment/timing_run.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace obscura {

// What a run found, beside what was measured of other programs: a table and a histogram.
std::string inWords(const TimingRun& run);

// The same for programs: `masks`, `mean_ms`, `sd_ms`, `min_ms`, `max_ms`, `wrong_frames` and more.
// What no mask was held for is null.
nlohmann::ordered_json spell(const TimingRun& run);

// A line for each mask: its number, milliseconds, refreshes, missed intervals.
std::string csv(const TimingRun& run);

} // namespace obscura
