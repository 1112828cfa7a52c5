#pragma once

#include "protocols/reader/responses.h"

#include <filesystem>
#include <string>
#include <vector>

namespace obscura {

// What any trial has, in two long tables beside the rows of pairs (responses.h): a line for each
// phase that was shown, and one for each question. UTF-8 CSV, times in milliseconds; what a line
// lacks is empty or 0. docs/measurement.md describes the columns.

// Whose line it is, and of which trial; both tables begin with this.
struct TrialKey {
    int schemaVersion = 1;
    std::string rowId; // of the line: participant-session-trial-phase or -question
    std::string studyId, participantId, sessionId;
    bool simulated = false, rehearsal = false;
    int slotId = 0;
    int trialIndex = 0;             // from 1; 0 for the pages around the trials
    std::string trialKind = "main"; // practice, main, catch, or for those pages before or after
    int repeatIndex = 1, block = 1; // from 1
    std::string conditionId, level, scene, hypothesis;
    std::string roles;      // by place: "b>a"
    std::string techniques; // of the same: "blizzard24>none"
};

struct PhaseRow {
    TrialKey trial;
    int phaseIndex = 0; // from 1
    std::string phase;
    std::string images, files, sha256; // roles, paths, hashes of what was shown; "+" between
    double onsetMs = 0, viewMs = 0;
    int framesPlanned = 0, framesShown = 0, missedFrames = 0;
    int earlyPresses = 0, hastyPresses = 0;
    bool interrupted = false, timedOut = false;
    double refreshHz = 0;
    std::string timestampSource;
};

struct AnswerRow {
    TrialKey trial;
    std::string phase, question, kind;
    std::string value;     // experiment/form.h; "" for a question left open
    std::string role;      // of the image chosen, or of those ranked, best first: "b>a"
    double responseMs = 0; // from the page's onset
    bool interrupted = false;
    std::string appVersion, gitCommit, protocolSha256, designSha256, machineId, wallTimeUtc;
};

// Column by column, in the order of the file: what it means, and what may stand in it.
struct TableColumn {
    std::string name, description, expected;
};
std::vector<TableColumn> phaseColumns();
std::vector<TableColumn> answerColumns();

std::string phaseHeader();
std::string phaseLine(const PhaseRow& row);
std::string answerHeader();
std::string answerLine(const AnswerRow& row);

template <typename Row>
struct TrialTable {
    std::vector<Row> rows;
    std::vector<int> lines; // of each row, from 1 (the header)
    std::vector<BadRow> bad;
};

// Read one session's table and check each cell. Errors and `lenient` are those of readResponses.
TrialTable<PhaseRow> readPhases(const std::filesystem::path& path, bool lenient);
TrialTable<AnswerRow> readAnswers(const std::filesystem::path& path, bool lenient);

// Lines as the journal keeps them, without a header; `file` is what errors name.
std::vector<PhaseRow> phaseRowsOf(const std::string& lines, const std::string& file);
std::vector<AnswerRow> answerRowsOf(const std::string& lines, const std::string& file);

} // namespace obscura
