#pragma once

#include "experiment/ledger.h"
#include "experiment/observer.h"
#include "experiment/selection.h"
#include "experiment/study.h"
#include "experiment/trial.h"
#include "protocols/reader/responses.h"

namespace obscura {

// What holds for all of a session's trials.
struct Context {
    const Study& study;
    const SessionId& session;
    const Assignment& assignment;
    const Refresh& refresh;
    std::string designSha256; // of Study::design()
};

// A trial's outcome as the row that is kept of it.
Response makeRow(const Context& context, const Upcoming& trial, const PlannedTrial& planned,
                 const TrialRecord& record);

} // namespace obscura
