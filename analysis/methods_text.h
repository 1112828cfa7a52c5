#pragma once

#include "analysis/findings.h"

#include <string>
#include <vector>

namespace obscura {

// The methods of a study as a paper tells them, in paragraphs ready to paste: design, people,
// apparatus, analysis, software. What the data do not know stands in square brackets, to be added
// by hand.
std::vector<std::string> methodsText(const Findings& findings);

// Who rendered the stimuli, and how large they are.
std::string renderedBy(const Manifest& stimuli);

} // namespace obscura
