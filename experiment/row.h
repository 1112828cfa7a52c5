#pragma once

#include "experiment/ledger.h"
#include "experiment/observer.h"
#include "experiment/selection.h"
#include "experiment/study.h"
#include "experiment/trial.h"
#include "protocols/reader/responses.h"

#include <optional>

namespace obscura {

// What holds for all of a session's trials.
struct Context {
    const Study& study;
    const SessionId& session;
    const Assignment& assignment;
    const Refresh& refresh;
    std::string designSha256; // of Study::design()
};

// Where in a trial's phases the columns of a pair come from: image 1, at once a locked grey, at
// once image 2, and a choice between the two without a third option. None in other trials, which
// have no such rows.
struct PairPhases {
    std::size_t first = 0, mask = 0, second = 0, question = 0;
    std::size_t answer = 0; // among those of the trial
};
std::optional<PairPhases> pairPhasesOf(const std::vector<Phase>& phases);

// A trial's outcome as the row that is kept of it.
Response makeRow(const Context& context, const Upcoming& trial, const PlannedTrial& planned,
                 const TrialRecord& record, const PairPhases& pair);

} // namespace obscura
