#pragma once

#include "analysis/scales/scale_data.h"

#include <string>
#include <vector>

namespace obscura {

// One condition of a ladder: how its images differ, and how it was answered.
struct Step {
    std::string condition, label;
    // By each of the stimuli's measures, in their order; absent: not known.
    std::vector<std::optional<double>> differences{};
    double successes = 0, trials = 0;
};

// The differences of its images by all measures.
std::vector<std::optional<double>> differencesOf(const Manifest* stimuli,
                                                 const std::string& condition, const std::string& a,
                                                 const std::string& b);

// Fills a ladder's numbers: the difference by one measure of the stimuli, or without one the place
// in the order of the steps. Levels are negated where the share falls with them, so that the curve
// rises.
void setLevels(Ladder& ladder, const std::vector<Step>& steps, const Manifest* stimuli,
               std::optional<std::size_t> measure);

// The first measure that every step has and that rises or falls as the protocol lists the steps.
std::optional<std::size_t> orderlyMeasure(const std::vector<Step>& steps);

// Of choices between a and b: a ladder for each measure that has at least three different values,
// all of them known. `group` says where; `success` what is counted.
void addPairLadders(std::vector<Ladder>& ladders, const ScaleGroup& group,
                    const std::vector<Step>& steps, const Manifest* stimuli,
                    const std::string& success);

} // namespace obscura
