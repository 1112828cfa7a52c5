#pragma once

#include "analysis/plan/plan.h"
#include "report/paper_figure.h"

namespace obscura {

// Power against the true share, a curve for each claim that is a difference, at the planned number;
// equivalences have their numbers in the plan's text.
Figure powerCurves(const Plan& plan);

} // namespace obscura
