#include "experiment/recorder.h"

#include "experiment/machine.h"

#include <nlohmann/json.hpp>

namespace obscura {

using nlohmann::ordered_json;

namespace {

std::string entry(std::string_view event, const ordered_json& details) {
    ordered_json json = {{"event", event}, {"time", utcNow()}};
    json.update(details);
    return json.dump() + "\n";
}

} // namespace

Recorder::Recorder(const DataFolder& folder, const SessionId& session, int slot)
    : rows_(AppendFile::create(folder.rows(session), responseHeader())),
      journal_(AppendFile::create(folder.journal(session),
                                  entry("session_started", {{"format_version", 2},
                                                            {"participant", session.participant},
                                                            {"session", session.number},
                                                            {"simulated", session.simulated},
                                                            {"rehearsal", session.rehearsal},
                                                            {"slot", slot}}))) {}

void Recorder::trialStarted(int trial, const std::string& condition) {
    journal_.append(entry("trial_started", {{"trial", trial}, {"condition", condition}}));
}

void Recorder::record(const Response& row) { rows_.append(responseLine(row)); }

void Recorder::hastyPresses(int trial, int count) {
    journal_.append(entry("presses_ignored", {{"trial", trial}, {"count", count}}));
}

void Recorder::end(std::string_view reason) {
    journal_.append(entry("session_ended", {{"reason", reason}}));
}

} // namespace obscura
