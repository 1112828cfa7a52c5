#pragma once

#include "experiment/broken_session.h"
#include "experiment/data_folder.h"
#include "experiment/observer.h"
#include "experiment/study.h"

#include <filesystem>

namespace obscura {

// One participant, from claiming a slot to the last row: the pages before, instructions, every
// trial in the slot's order, the pages after, thanks. Each row is on disk before the next trial
// begins. True when all trials were recorded; otherwise the person left, the rows so far are kept
// and the slot is given back. A signal does the same, and then throws EndedBySignal. A rehearsal
// takes no slot: it has the order of the first. Where an answer before the trials ends the session
// (no consent), nothing but that answer is kept.
bool runSession(const Study& study, const DataFolder& folder, const SessionId& session,
                Observer& observer);

// The same from where it broke off: instructions, the trials that have not been shown, thanks.
bool resumeSession(const Study& study, const DataFolder& folder, const BrokenSession& broken,
                   Observer& observer);

} // namespace obscura
