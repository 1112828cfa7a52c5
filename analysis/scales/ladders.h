#pragma once

#include "analysis/scales/scale_data.h"

#include <string>
#include <vector>

namespace obscura {

// One condition of a ladder: how its images differ, and how it was answered.
struct Step {
    std::string condition, label;
    std::optional<double> difference; // in the stimuli; absent: not known
    double successes = 0, trials = 0;
};

// Fills a ladder's numbers: the difference in the stimuli where every step has one and, if they
// `mustFollowOrder`, these rise or fall as the protocol lists the steps; else the place in that
// order. Levels are negated where the share falls with them, so that the curve rises.
void setLevels(Ladder& ladder, const std::vector<Step>& steps, bool mustFollowOrder);

} // namespace obscura
