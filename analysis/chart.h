#pragma once

#include "analysis/findings.h"

#include <string>

namespace obscura {

// The votes as a gnuplot script and as SVG: for each condition, grouped by complexity level, the
// share of b with the 95 % interval of the exact test, on a common axis with the even split marked,
// and the counts beside it. Colours are Okabe and Ito's; what they say is also said by filled and
// open marks. Simulated data are marked in the picture itself, which may travel without its page.
std::string chartScript(const Findings& findings);
std::string chartSvg(const Findings& findings);

} // namespace obscura
