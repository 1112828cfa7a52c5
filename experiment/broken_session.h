#pragma once

#include "experiment/data_folder.h"
#include "experiment/selection.h"
#include "experiment/study.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace obscura {

// A session that ended before its last trial, by a crash, a signal or the participant's wish, and
// that can be gone on with.
struct BrokenSession {
    SessionId session;
    int slot = 0;                      // whose order it has
    std::vector<PastTrial> history;    // what next() led to; a half-seen trial is interrupted
    int trials = 0;                    // that began, and so have a number
    std::vector<std::string> halfSeen; // conditions of those that began and were not answered
    std::set<std::string> pages; // before and after the trials, that were ended: "before/consent"
};

std::string pageKey(std::string_view kind, const std::string& page); // "before/consent"

// With which the reason of a session begins that is not to be gone on with.
constexpr std::string_view endedByAnswer = "ended by the answer to ";

// Replays the session's journal: whatever the participant has seen is not shown again. An Error
// says why nobody can go on with it: there is none, it was completed, it broke off longer ago than
// the protocol's `resumeMinutes` (or in the future: the clock was set back), its journal is of an
// earlier version or fits another design, or a line of it is damaged. Whether the session still
// runs, or another has its slot by now, the ledger knows (Ledger::takeBack).
BrokenSession brokenSession(const Study& study, const DataFolder& folder, const SessionId& session);

// The reason with which a journal says that its session ended; "" where it does not say.
std::string endOf(const std::filesystem::path& journal);

} // namespace obscura
