#pragma once

#include "bench/sweep/frame_rates.h"
#include "bench/sweep/growth.h"

#include <string>
#include <vector>

namespace obscura {

// Tables of sweep.html. Points are links to their details, "#p<firstId + index>".

// The configurations on one measure's front.
std::string frontTable(const SweepGroup& group, const ErrorMeasure& measure,
                       const std::vector<std::string>& techniques, std::size_t firstId);

// All configurations by the default measure, and what to take instead of those off its front.
std::string rankingTable(const SweepGroup& group, const std::vector<std::string>& techniques,
                         std::size_t firstId);

// All numbers of one point.
std::string detailsOf(const SweepRow& point);

std::string frameRatesHtml(const FrameRates& rates);
// `techniqueOf` a configuration: its place among the sweep's techniques.
std::string slopesHtml(const std::vector<Growth>& growth,
                       const std::map<std::string, std::size_t>& techniqueOf);

// A technique's mark, as it stands in charts.
std::string markHtml(std::size_t technique);

} // namespace obscura
