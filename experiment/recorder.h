#pragma once

#include "experiment/append_file.h"
#include "experiment/data_folder.h"
#include "protocols/responses.h"

#include <string>
#include <string_view>

namespace obscura {

// Keeps a session's rows and its journal, both safe on disk when a function returns. What the
// journal says: session_started, then for each trial trial_started and trial_recorded, then
// session_ended with the reason ("completed" or why not). A trial_started without trial_recorded
// is an exposure that was broken off; a journal without session_ended is a crash.
class Recorder {
  public:
    // New files; an Error when this session has any.
    Recorder(const DataFolder& folder, const SessionId& session, int slot);

    void trialStarted(int trial, const std::string& condition);
    void record(const Response& row);
    void end(std::string_view reason);

  private:
    AppendFile rows_;
    AppendFile journal_;
};

} // namespace obscura
