#pragma once

#include "experiment/observer.h"
#include "experiment/trial.h"

#include <functional>

namespace obscura {

// Runs what the observer has prepared through its machine: true when answered, false when the
// person left. `journal` writes down that the exposure begins. A signal throws EndedBySignal.
bool play(TrialMachine& machine, Observer& observer, const std::function<void()>& journal);

} // namespace obscura
