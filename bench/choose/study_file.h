#pragma once

#include "protocols/reader/sweep.h"

#include <string>

namespace obscura {

// The study as a file of its own that `obscura-bench sweep` takes as it is, with what the command
// line changed and with cameras that were found; of several sizes the first, and without growth. A
// scene that stands at several radii becomes one at each. Environment images have the path that
// they have now, `folder` before it. What is read back writes the same text.
std::string studyText(const SweepStudy& study, const std::string& folder);

// What such a text begins with.
extern const std::string_view studyTextHead;

} // namespace obscura
