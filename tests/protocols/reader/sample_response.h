#pragma once

#include "protocols/reader/responses.h"

#include <fmt/format.h>

#include <string>

namespace obscura::test {

// A row that passes every check: participant `P<number>` in one condition, choosing b or a. The
// ordering is the thesis': seven rows of a square, then the same with the images exchanged.
inline Response sampleResponse(int number, const std::string& condition, bool choseB) {
    Response row;
    row.participantId = fmt::format("P{:02}", number);
    row.sessionId = "1";
    row.rowId = fmt::format("{}-1-{}", row.participantId, condition);
    row.studyId = "sample";
    row.slotId = number;
    row.squareId = (number - 1) / 14 + 1;
    row.squareRow = (number - 1) % 7 + 1;
    row.pairsReversed = (number - 1) % 14 >= 7;
    row.trialIndex = 1;
    row.conditionId = condition;
    row.level = "moderate";
    row.scene = "atrium";
    row.hypothesis = "H1";
    row.techniqueA = "none";
    row.techniqueB = "blizzard24";
    row.paramsA = "{}";
    row.paramsB = R"({"radius":0.5,"samples":24})";
    const std::string a(64, 'a'), b(64, 'b');
    row.firstIs = row.pairsReversed ? "b" : "a";
    row.stimFirst = row.pairsReversed ? "b.png" : "a.png";
    row.stimSecond = row.pairsReversed ? "a.png" : "b.png";
    row.sha256First = row.pairsReversed ? b : a;
    row.sha256Second = row.pairsReversed ? a : b;
    row.onset1Ms = 10;
    row.view1Ms = 4000;
    row.maskFramesPlanned = row.maskFramesShown = 120;
    row.maskMs = 2000;
    row.onset2Ms = 6010;
    row.view2Ms = 3000;
    row.questionOnsetMs = 9010;
    row.decisionRtMs = 1200;
    row.refreshHz = 60;
    row.timestampSource = "finish";
    row.choseB = choseB;
    row.chosenPosition = choseB == row.pairsReversed ? 1 : 2;
    row.chosenTechnique = choseB ? row.techniqueB : row.techniqueA;
    row.appVersion = "0.1.0";
    row.gitCommit = "0123456789ab";
    row.protocolSha256 = std::string(64, '0');
    row.machineId = "lab";
    row.wallTimeUtc = "2026-01-31T23:59:59Z";
    row.designSha256 = std::string(64, 'd');
    return row;
}

} // namespace obscura::test
