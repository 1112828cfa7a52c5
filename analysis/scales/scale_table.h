#pragma once

#include "analysis/scales/scale_kinds.h"
#include "analysis/table.h"

#include <string>
#include <vector>

namespace obscura {

// The scales as people read them: a line for each technique, those of a scale by rising value, each
// with the test of its step to the next.
Table scaleTable(const std::vector<Scaled>& scales);

// The same as a terminal shows it, with what is to be known of each scale; ends with a line feed.
std::string scalesText(const std::vector<Scaled>& scales);

// As programs read them: a line for each item, step, diagnostic and note, every figure with all its
// digits. `source` is that of the data (sourceOf).
std::string scalesCsv(const ScaleFindings& scales, const std::string& source);

} // namespace obscura
