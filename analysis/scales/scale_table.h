#pragma once

#include "analysis/findings.h"
#include "analysis/table.h"

#include <string>
#include <vector>

namespace obscura {

// The scales as people read them: a line for each technique, those of a scale by rising value, each
// with the test of its step to the next.
Table scaleTable(const std::vector<Scaled>& scales);

// How its intervals came about, its diagnostics and its notes, a line each.
std::vector<std::string> scaleRemarks(const ScaleResult& result);

// The same as a terminal shows it, with what is to be known of each scale; ends with a line feed.
std::string scalesText(const std::vector<Scaled>& scales);

// What the leading scales say, one sentence each; and what has none.
std::vector<std::string> scaleSentences(const ScaleFindings& scales);

// As programs read them: a line for each item, step, diagnostic and note, every figure with all its
// digits. `source` is that of the data (sourceOf).
std::string scalesCsv(const ScaleFindings& scales, const std::string& source);

// "atrium, sky" or "all scenes and levels", with the question where there are several.
std::string placeOf(const ScaleGroup& group);

} // namespace obscura
