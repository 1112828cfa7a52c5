#pragma once

#include "base/error.h"
#include "base/symbol.h"
#include "protocols/reader/responses.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace obscura {

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
    // Equal for rows of one person.
    std::uint64_t person() const {
        return std::uint64_t{studyId.number()} << 32 | participantId.number();
    }
};

struct Answer {
    Vote row;
    Symbol file;
    int line = 0;

    Place place(std::string_view column = {}) const {
        return {file.text(), line, 0, std::string(column)};
    }
};

} // namespace obscura
