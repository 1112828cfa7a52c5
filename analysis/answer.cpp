#include "analysis/answer.h"

#include "base/csv.h"

#include <ctime>
#include <functional>

namespace obscura {

namespace {

// A text's symbol, found at once when it is that of the row before.
Symbol symbolOf(const std::string& text, Symbol before) {
    return before.text() == text ? before : Symbol(text);
}

// FNV-1a, and the library's: as good as one of 128 bits.
std::array<std::uint64_t, 2> hashOf(std::string_view text) {
    std::uint64_t hash = 14695981039346656037ull;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
    return {hash, std::hash<std::string_view>()(text)};
}

// Of "2026-01-31T23:59:59Z", whose form has been checked.
std::int64_t secondsOf(const std::string& time) {
    const auto number = [&](std::size_t at, std::size_t length) {
        int value = 0;
        readCell(std::string_view(time).substr(at, length), value);
        return value;
    };
    std::tm parts{};
    parts.tm_year = number(0, 4) - 1900;
    parts.tm_mon = number(5, 2) - 1;
    parts.tm_mday = number(8, 2);
    return std::int64_t{::timegm(&parts)} + 3600 * number(11, 2) + 60 * number(14, 2) +
           number(17, 2);
}

} // namespace

Vote::Vote(const Response& row, const Vote& above) {
    aFirst = row.firstIs == "a";
    studyId = symbolOf(row.studyId, above.studyId);
    participantId = symbolOf(row.participantId, above.participantId);
    sessionId = symbolOf(row.sessionId, above.sessionId);
    conditionId = symbolOf(row.conditionId, above.conditionId);
    level = symbolOf(row.level, above.level);
    scene = symbolOf(row.scene, above.scene);
    hypothesis = symbolOf(row.hypothesis, above.hypothesis);
    techniqueA = symbolOf(row.techniqueA, above.techniqueA);
    techniqueB = symbolOf(row.techniqueB, above.techniqueB);
    sha256A = symbolOf(aFirst ? row.sha256First : row.sha256Second, above.sha256A);
    sha256B = symbolOf(aFirst ? row.sha256Second : row.sha256First, above.sha256B);
    trialKind = symbolOf(row.trialKind, above.trialKind);
    timestampSource = symbolOf(row.timestampSource, above.timestampSource);
    appVersion = symbolOf(row.appVersion, above.appVersion);
    gitCommit = symbolOf(row.gitCommit, above.gitCommit);
    protocolSha256 = symbolOf(row.protocolSha256, above.protocolSha256);
    designSha256 = symbolOf(row.designSha256, above.designSha256);
    machineId = symbolOf(row.machineId, above.machineId);
    rowIdHash = hashOf(row.rowId);
    wallTime = secondsOf(row.wallTimeUtc);
    maskMs = row.maskMs;
    view1Ms = row.view1Ms;
    view2Ms = row.view2Ms;
    decisionRtMs = row.decisionRtMs;
    refreshHz = row.refreshHz;
    slotId = row.slotId;
    squareId = row.squareId;
    squareRow = row.squareRow;
    trialIndex = row.trialIndex;
    repeatIndex = row.repeatIndex;
    maskFramesPlanned = row.maskFramesPlanned;
    maskFramesShown = row.maskFramesShown;
    missedFrames = row.missedFrames;
    earlyPressesInMask = row.earlyPressesInMask;
    simulated = row.simulated;
    rehearsal = row.rehearsal;
    pairsReversed = row.pairsReversed;
    choseB = row.choseB;
    interrupted = row.interrupted;
}

} // namespace obscura
