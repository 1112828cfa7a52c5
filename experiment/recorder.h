#pragma once

#include "experiment/append_file.h"
#include "experiment/broken_session.h"
#include "experiment/data_folder.h"
#include "protocols/reader/responses.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace obscura {

// What is kept of one trial: lines of each table, whole, with their line feeds.
struct TrialLines {
    std::string rows;    // of pairs; "" where the trial is none
    std::string phases;  // protocols/reader/trial_tables.h
    std::string answers; // the same
};

// Keeps a session's tables and its journal, all safe on disk when a function returns. The journal
// says session_started, then trial_started for each trial before its first image and what leads to
// it by the clock, trial_finished with the lines of all tables, page_finished with those of a page
// before or after the trials, presses_ignored where Space was pressed too soon, then session_ended
// with the reason. A trial that was started but not finished was broken off while the participant
// looked; a journal without session_ended is a crash. The journal is written first: what a crash
// keeps from the tables, restoreTables() writes.
class Recorder {
  public:
    // New files; an Error when this session has any. `slot`: whose order is shown; `pairs`: whether
    // its trials have rows.
    Recorder(const DataFolder& folder, const SessionId& session, int slot, bool pairs);

    // Goes on with the files of a session that broke off, once restoreTables() has mended them.
    // The journal says session_resumed, after how many trials, and which were half seen.
    static Recorder resume(const DataFolder& folder, const BrokenSession& broken, bool pairs);

    void trialStarted(int trial, const std::string& condition);
    void finished(int trial, const TrialLines& lines);
    // A page outside trials, `kind` "before" or "after" them.
    void pageFinished(std::string_view kind, const std::string& page, const TrialLines& lines);
    void hastyPresses(int trial, int count); // of Space, ignored because an image had just come on
    void end(std::string_view reason);

  private:
    Recorder(std::optional<AppendFile> rows, AppendFile phases, AppendFile answers,
             AppendFile journal);
    void keep(std::string_view event, nlohmann::ordered_json details, const TrialLines& lines);

    // No rows where the study's trials are no pairs.
    std::optional<AppendFile> rows_;
    AppendFile phases_, answers_, journal_;
};

// Writes into a session's tables the lines that its journal has and they lack, and takes out a last
// line that was cut. How many tables were mended. An Error when one has other lines than the
// journal. The session must not be running.
int restoreTables(const DataFolder& folder, const SessionId& session);

} // namespace obscura
