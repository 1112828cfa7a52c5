#pragma once

#include "base/symbol.h"
#include "protocols/reader/responses.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// Gathers the rows of a study and makes sure that they belong together. Whatever does not is an
// Error naming two rows that disagree, unless the rules ask for it; nothing is left out in silence.

// What is kept of a row: what statistics ask for, in a quarter of its size. Fields are named as in
// Response.
struct Vote {
    Vote() = default;
    // Texts that are those of the row above are found at once.
    Vote(const Response& row, const Vote& above);
    explicit Vote(const Response& row) : Vote(row, Vote()) {}

    Symbol studyId, participantId, sessionId, conditionId, level, scene, hypothesis;
    Symbol techniqueA, techniqueB, sha256A, sha256B, trialKind, timestampSource;
    Symbol appVersion, gitCommit, protocolSha256, designSha256, machineId;
    std::array<std::uint64_t, 2> rowIdHash{};
    std::int64_t wallTime = 0; // seconds since 1970
    double maskMs = 0, view1Ms = 0, view2Ms = 0, decisionRtMs = 0, refreshHz = 0;
    int slotId = 0, squareId = 0, squareRow = 0, trialIndex = 0, repeatIndex = 1;
    int maskFramesPlanned = 0, maskFramesShown = 0, missedFrames = 0, earlyPressesInMask = 0;
    bool simulated = false, rehearsal = false, pairsReversed = false;
    bool aFirst = true, choseB = false, interrupted = false;

    bool choseSecond() const { return choseB == aFirst; }
};

struct Answer {
    Vote row;
    Symbol file;
    int line = 0;

    Place place(std::string_view column = {}) const {
        return {file.text(), line, 0, std::string(column)};
    }
};

enum class SimulatedRows { refuse, exclude, only, include };

struct AnswerRules {
    // Rows of programs among rows of people. `refuse` accepts files that are all of one kind.
    SimulatedRows simulated = SimulatedRows::refuse;
    bool mixedStudies = false;   // pool several study_id
    bool mixedProtocols = false; // pool several designs of one study
    bool duplicates = false;     // count the first of rows for one trial, leave out the others
    // A trial during which the window lost the screen was still answered: it is counted and
    // reported, unless this is false.
    bool interrupted = true;
    bool lenient = false; // skip rows that cannot be read
};

struct LeftOut {
    int practice = 0, catches = 0, interrupted = 0, duplicates = 0;
    int simulated = 0, real = 0, rehearsed = 0;
};

struct Answers {
    std::vector<Answer> counted;    // main trials, in the order of files and lines
    std::vector<std::string> order; // of conditions, where a study's folder keeps its design
    LeftOut leftOut;
    std::vector<BadRow> bad; // skipped because of `lenient`
    int files = 0;
    int earlierFiles = 0; // of those, in the format of an earlier version
};

// `data`: CSV files, or folders of them (a study's folder with its data/ in it). At least one row
// must be left to count.
Answers collectAnswers(std::span<const std::filesystem::path> data, const AnswerRules& rules);

// The rules alone, for trials that stand in another table than that of pairs: those of
// `answers.counted` that count stay. `number` is that of a column in that table, for errors.
using ColumnNumber = int (*)(std::string_view column);
void applyRules(Answers& answers, const AnswerRules& rules, ColumnNumber number);

} // namespace obscura
