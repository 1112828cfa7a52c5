#include "experiment/row.h"

#include "base/version.h"
#include "experiment/machine.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace obscura {

namespace {

std::string settings(const Recipe& recipe) { return nlohmann::json(recipe.settings).dump(); }

Response identity(const Context& context, const Upcoming& trial, const PlannedTrial& planned) {
    Response row;
    row.rowId =
        fmt::format("{}-{}-{}", context.session.participant, context.session.number, trial.index);
    row.studyId = context.study.protocol.name;
    row.participantId = context.session.participant;
    row.sessionId = fmt::format("{}", context.session.number);
    row.simulated = context.session.simulated;
    row.rehearsal = context.session.rehearsal;
    row.designSha256 = context.designSha256;
    row.slotId = context.assignment.slot;
    row.squareId = context.assignment.square;
    row.squareRow = context.assignment.row;
    row.pairsReversed = context.assignment.exchange != 0;
    row.trialIndex = trial.index;
    row.trialKind = nameOf(planned.kind);
    row.repeatIndex = planned.repeat;
    return row;
}

void addCondition(Response& row, const PairRecord& pair, bool reversed) {
    const ImageRecord& first = reversed ? pair.b : pair.a;
    const ImageRecord& second = reversed ? pair.a : pair.b;
    row.conditionId = pair.condition;
    row.level = pair.level;
    row.scene = pair.view;
    row.hypothesis = pair.hypothesis;
    row.techniqueA = pair.a.name;
    row.techniqueB = pair.b.name;
    row.paramsA = settings(pair.a.recipe);
    row.paramsB = settings(pair.b.recipe);
    row.stimFirst = first.image.path;
    row.stimSecond = second.image.path;
    row.sha256First = first.image.sha256;
    row.sha256Second = second.image.sha256;
    row.firstIs = reversed ? 'b' : 'a';
}

void addTiming(Response& row, const TrialRecord& trial, const Refresh& refresh) {
    row.onset1Ms = 1000 * trial.onset1;
    row.view1Ms = 1000 * trial.view1;
    row.maskFramesPlanned = trial.maskFramesPlanned;
    row.maskFramesShown = trial.maskFramesShown;
    row.maskMs = 1000 * trial.mask;
    row.onset2Ms = 1000 * trial.onset2;
    row.view2Ms = 1000 * trial.view2;
    row.questionOnsetMs = 1000 * trial.questionOnset;
    row.decisionRtMs = 1000 * trial.decision;
    row.refreshHz = refresh.hz;
    row.missedFrames = trial.missedFrames;
    row.timestampSource = refresh.source;
}

void addAnswer(Response& row, const TrialRecord& trial) {
    row.chosenPosition = trial.chosen;
    row.choseB = (trial.chosen == 2) == (row.firstIs == "a");
    row.chosenTechnique = row.choseB ? row.techniqueB : row.techniqueA;
    row.interrupted = trial.interrupted;
    row.earlyPressesInMask = trial.earlyPresses;
}

void addProvenance(Response& row, const Protocol& protocol) {
    row.appVersion = version();
    row.gitCommit = commit();
    row.protocolSha256 = protocol.sha256;
    row.machineId = machineName();
    row.wallTimeUtc = utcNow();
}

} // namespace

Response makeRow(const Context& context, const Upcoming& trial, const PlannedTrial& planned,
                 const TrialRecord& record) {
    Response row = identity(context, trial, planned);
    addCondition(row, context.study.pair(trial.condition), trial.reversed);
    addTiming(row, record, context.refresh);
    addAnswer(row, record);
    addProvenance(row, context.study.protocol);
    return row;
}

} // namespace obscura
