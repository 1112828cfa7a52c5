#pragma once

#include "bench/choose/budget.h"
#include "bench/sweep/row.h"

#include <span>

namespace obscura {

// What a view's errors are to a budget.

// Time and flicker are not known yet, and within any limit.
ViewResult resultOf(const PictureError& matched, const PictureError& lit);

// Candidate::training of what these views gave. Flicker is not known.
double promise(const Budget& budget, std::span<const ViewResult> views);

} // namespace obscura
