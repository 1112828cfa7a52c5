#pragma once

#include "analysis/scales/scale_kinds.h"

#include <string>
#include <vector>

namespace obscura {

// Scales in words.

// "atrium, sky" or "all scenes and levels", with the question where there are several.
std::string placeOf(const ScaleGroup& group);

// How its intervals came about, its diagnostics and its notes, a line each.
std::vector<std::string> scaleRemarks(const ScaleResult& result);

// What the leading scales say, one sentence each; and what has none.
std::vector<std::string> scaleSentences(const ScaleFindings& scales);

// Numbers with a real minus sign; an interval as "0.10 to 0.52", with so many decimals as the
// scale's values ask for.
std::string spelt(double value, int decimals);
std::string spelt(const OpenInterval& bounds, int decimals);
int decimalsOf(const ScaleResult& result);

// The step that begins at an item; null at the last.
const ScaleStep* stepFrom(const ScaleResult& result, std::size_t item);

} // namespace obscura
