#pragma once

#include "bench/sweep/frame_rates.h"
#include "bench/sweep/growth.h"

#include <string>
#include <vector>

namespace obscura {

// Tables of sweep.html. Points are links to their details, "#p<firstId + index>".

// A row for each configuration that could be on a front, by rising milliseconds, and the cells of
// each measure ("c3"), of which the page's style shows those of the chosen one: rows of the class
// "f3" are on the front of the measure 3, those of "n3" within the uncertainty of time.
std::string frontTable(const SweepGroup& group, const std::vector<std::string>& techniques,
                       std::size_t firstId);

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
