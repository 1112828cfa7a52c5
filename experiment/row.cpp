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

void addTiming(Response& row, const TrialRecord& trial, const PairPhases& pair,
               const Refresh& refresh) {
    const PhaseRecord &first = trial.phases[pair.first], &mask = trial.phases[pair.mask],
                      &second = trial.phases[pair.second], &question = trial.phases[pair.question];
    row.onset1Ms = 1000 * first.onset;
    row.view1Ms = 1000 * first.view;
    row.maskFramesPlanned = mask.framesPlanned;
    row.maskFramesShown = mask.framesShown;
    row.maskMs = 1000 * mask.view;
    row.onset2Ms = 1000 * second.onset;
    row.view2Ms = 1000 * second.view;
    row.questionOnsetMs = 1000 * question.onset;
    row.decisionRtMs = 1000 * trial.answers[pair.answer].seconds;
    row.refreshHz = refresh.hz;
    row.missedFrames = mask.missedFrames;
    row.timestampSource = refresh.source;
    row.earlyPressesInMask = mask.earlyPresses;
}

void addAnswer(Response& row, const TrialRecord& trial, const PairPhases& pair) {
    row.chosenPosition = trial.answers[pair.answer].value == "2" ? 2 : 1;
    row.choseB = (row.chosenPosition == 2) == (row.firstIs == "a");
    row.chosenTechnique = row.choseB ? row.techniqueB : row.techniqueA;
    row.interrupted = trial.interrupted;
}

void addProvenance(Response& row, const Protocol& protocol) {
    row.appVersion = version();
    row.gitCommit = commit();
    row.protocolSha256 = protocol.sha256;
    row.machineId = machineName();
    row.wallTimeUtc = utcNow();
}

} // namespace

std::optional<PairPhases> pairPhasesOf(const std::vector<Phase>& phases) {
    PairPhases pair;
    const auto shows = [&](std::size_t i, const char* image) {
        return i < phases.size() && phases[i].images == std::vector<std::string>{image} &&
               phases[i].questions.empty();
    };
    while (pair.first < phases.size() && !shows(pair.first, "1"))
        ++pair.first;
    pair.mask = pair.first + 1;
    pair.second = pair.first + 2;
    if (!shows(pair.second, "2") || phases[pair.mask].grey < 0 || !phases[pair.mask].locked())
        return std::nullopt;
    for (pair.question = 0; pair.question < phases.size(); ++pair.question)
        for (const Question& question : phases[pair.question].questions) {
            if (question.images && question.options.size() == 2 && question.unsure.empty() &&
                !question.optional && !phases[pair.question].counted())
                return pair;
            ++pair.answer;
        }
    return std::nullopt;
}

Response makeRow(const Context& context, const Upcoming& trial, const PlannedTrial& planned,
                 const TrialRecord& record, const PairPhases& pair) {
    Response row = identity(context, trial, planned);
    addCondition(row, context.study.pair(trial.condition), trial.reversed);
    addTiming(row, record, pair, context.refresh);
    addAnswer(row, record, pair);
    addProvenance(row, context.study.protocol);
    return row;
}

} // namespace obscura
