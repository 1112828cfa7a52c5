#include "protocols/reader/trial_tables.h"

#include "base/csv.h"

#include <fmt/format.h>

#include <vector>

namespace obscura {

namespace {

// Every field with its column's name, once for header and line.

template <typename Visit>
void eachField(const TrialKey& key, Visit& visit) {
    visit("schema_version", key.schemaVersion);
    visit("row_id", key.rowId);
    visit("study_id", key.studyId);
    visit("participant_id", key.participantId);
    visit("session_id", key.sessionId);
    visit("simulated", key.simulated);
    visit("rehearsal", key.rehearsal);
    visit("slot_id", key.slotId);
    visit("trial_index", key.trialIndex);
    visit("trial_kind", key.trialKind);
    visit("repeat_index", key.repeatIndex);
    visit("block", key.block);
    visit("condition_id", key.conditionId);
    visit("level", key.level);
    visit("scene", key.scene);
    visit("hypothesis", key.hypothesis);
    visit("roles", key.roles);
    visit("techniques", key.techniques);
}

template <typename Visit>
void eachField(const PhaseRow& row, Visit visit) {
    eachField(row.trial, visit);
    visit("phase_index", row.phaseIndex);
    visit("phase", row.phase);
    visit("images", row.images);
    visit("files", row.files);
    visit("sha256", row.sha256);
    visit("onset_ms", row.onsetMs);
    visit("view_ms", row.viewMs);
    visit("frames_planned", row.framesPlanned);
    visit("frames_shown", row.framesShown);
    visit("missed_frames", row.missedFrames);
    visit("early_presses", row.earlyPresses);
    visit("hasty_presses", row.hastyPresses);
    visit("interrupted", row.interrupted);
    visit("timed_out", row.timedOut);
    visit("refresh_hz", row.refreshHz);
    visit("timestamp_source", row.timestampSource);
}

template <typename Visit>
void eachField(const AnswerRow& row, Visit visit) {
    eachField(row.trial, visit);
    visit("phase", row.phase);
    visit("question", row.question);
    visit("kind", row.kind);
    visit("value", row.value);
    visit("role", row.role);
    visit("response_ms", row.responseMs);
    visit("interrupted", row.interrupted);
    visit("app_version", row.appVersion);
    visit("git_commit", row.gitCommit);
    visit("protocol_sha256", row.protocolSha256);
    visit("design_sha256", row.designSha256);
    visit("machine_id", row.machineId);
    visit("wall_time_utc", row.wallTimeUtc);
}

std::string spelt(const std::string& text) { return csvCell(text); }
std::string spelt(int number) { return fmt::format("{}", number); }
std::string spelt(double number) { return fmt::format("{:.3f}", number); }
std::string spelt(bool flag) { return flag ? "1" : "0"; }

template <typename Row>
std::string headerOf() {
    std::vector<std::string> names;
    eachField(Row(), [&](const char* name, const auto&) { names.emplace_back(name); });
    return fmt::format("{}\n", fmt::join(names, ","));
}

template <typename Row>
std::string lineOf(const Row& row) {
    std::vector<std::string> cells;
    eachField(row, [&](const char*, const auto& value) { cells.push_back(spelt(value)); });
    return fmt::format("{}\n", fmt::join(cells, ","));
}

} // namespace

std::string phaseHeader() { return headerOf<PhaseRow>(); }
std::string phaseLine(const PhaseRow& row) { return lineOf(row); }
std::string answerHeader() { return headerOf<AnswerRow>(); }
std::string answerLine(const AnswerRow& row) { return lineOf(row); }

} // namespace obscura
