#pragma once

#include "analysis/plan/plan.h"

#include <vector>

namespace obscura {

// Of each condition of main trials that is a pair. An Error where the manifest lacks predicted JOD.
std::vector<PredictedPair> predictedPairs(const Protocol& protocol, const Manifest& stimuli);

} // namespace obscura
