#pragma once

#include "bench/choose/choose.h"
#include "report/paper_figure.h"

namespace obscura {

// A choice as a picture for papers. Above, the answer and its reason; then a row for each measured
// candidate: milliseconds, and each measure that is limited or to be best, with the bounds that
// decide and the limits. Below, on axes of their own, all candidates at a glance, where the
// measured ones have the numbers of their rows.
Figure choiceFigure(const SweepStudy& study, const Budget& budget, const Choice& choice);

} // namespace obscura
