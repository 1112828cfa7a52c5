#pragma once

#include "analysis/export/study_data.h"

#include <string>

namespace obscura {

// Gives every participant a name that nobody can trace: eight letters and digits from the system's
// random numbers, in the rows, their row_id and the order of sessions. Returns what joins the two,
// CSV: participant_id, exported_as.
std::string renameParticipants(RecordedStudy& data);

} // namespace obscura
