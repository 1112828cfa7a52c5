#pragma once

#include "experiment/observer.h"
#include "experiment/selection.h"
#include "experiment/trial.h"

#include <functional>
#include <vector>

namespace obscura {

// The `index`th of so many trials, from 1.
Upcoming upcoming(const Protocol& protocol, const PlannedTrial& planned, int index, int count);

// Runs a trial before an observer: true when it was finished, false when the person left.
// `exposing` is called just before the first image is shown.
bool play(TrialMachine& machine, Observer& observer, const std::function<void()>& exposing);

// What an order may depend on: each answer as it was given, but of images the role in place of the
// number.
PastTrial remember(const std::vector<Phase>& phases, const Upcoming& trial,
                   const TrialRecord& record);

} // namespace obscura
