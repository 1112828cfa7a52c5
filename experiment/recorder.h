#pragma once

#include "experiment/append_file.h"
#include "experiment/data_folder.h"
#include "protocols/reader/responses.h"

#include <string>
#include <string_view>

namespace obscura {

// Keeps a session's rows and its journal, both safe on disk when a function returns. The journal
// says session_started, then trial_started for each trial before its first image, presses_ignored
// where Space was pressed too soon, then session_ended with the reason. A trial that was started
// but has no row was broken off while the participant looked; a journal without session_ended is a
// crash.
class Recorder {
  public:
    // New files; an Error when this session has any. `slot`: whose order is shown.
    Recorder(const DataFolder& folder, const SessionId& session, int slot);

    void trialStarted(int trial, const std::string& condition);
    void record(const Response& row);
    void hastyPresses(int trial, int count); // of Space, ignored because an image had just come on
    void end(std::string_view reason);

  private:
    AppendFile rows_;
    AppendFile journal_;
};

} // namespace obscura
