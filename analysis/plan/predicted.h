#pragma once

#include "protocols/reader/manifest.h"
#include "protocols/reader/protocol.h"

#include <string>
#include <vector>

namespace obscura {

// How people are expected to choose in a condition, by the predicted JOD of its images and not by
// any answer: the mean over both orders (inference/thurstone_observer.h).
struct PredictedPair {
    std::string condition;
    double jodA = 10, jodB = 10;
    double shareB = 0.5, unsure = 0; // of all answers
};

// Of each condition of main trials that is a pair. An Error where the manifest lacks predicted JOD.
std::vector<PredictedPair> predictedPairs(const Protocol& protocol, const Manifest& stimuli);

} // namespace obscura
