#pragma once

#include "base/files.h"
#include "protocols/reader/trial_tables.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

namespace obscura::test {

// The answer of participant `P<number>` to the only question of a trial, as the presenter writes
// it.
inline AnswerRow answerOf(int number, int trial, const std::string& condition,
                          const std::string& roles, const std::string& techniques,
                          const std::string& kind, const std::string& value,
                          const std::string& role = {}) {
    AnswerRow row;
    row.trial.participantId = fmt::format("P{:02}", number);
    row.trial.sessionId = "1";
    row.trial.rowId = fmt::format("{}-1-{}-q", row.trial.participantId, trial);
    row.trial.studyId = "sample";
    row.trial.slotId = number;
    row.trial.trialIndex = trial;
    row.trial.conditionId = condition;
    row.trial.scene = "atrium";
    row.trial.level = "sky";
    row.trial.roles = roles;
    row.trial.techniques = techniques;
    row.phase = "vote";
    row.question = "q";
    row.kind = kind;
    row.value = value;
    row.role = role;
    row.responseMs = 900;
    row.appVersion = "0.1.0";
    row.gitCommit = "0123456789ab";
    row.protocolSha256 = row.designSha256 = std::string(64, '0');
    row.machineId = "m";
    row.wallTimeUtc = "2026-11-29T12:00:00Z";
    return row;
}

// One table of answers in `folder`/sessions, and the design beside it where one is given.
inline std::filesystem::path writeTrials(const std::filesystem::path& folder,
                                         const std::vector<AnswerRow>& rows,
                                         const std::string& design = {}) {
    std::string content = answerHeader();
    for (const AnswerRow& row : rows)
        content += answerLine(row);
    writeFile(folder / "sessions" / "study-sample_answers.csv", content);
    if (!design.empty())
        writeFile(folder / "sessions" / "design.json",
                  "{\"design\":" + design + ",\"format_version\":1}");
    return folder;
}

} // namespace obscura::test
