#include "experiment/session.h"

#include "experiment/machine.h"
#include "experiment/recorder.h"
#include "experiment/schedule.h"
#include "experiment/trial.h"
#include "protocols/files.h"
#include "protocols/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace obscura {

using nlohmann::ordered_json;

namespace {

// Everything a row needs besides the trial itself.
struct Context {
    const Study& study;
    const SessionId& session;
    const Assignment& assignment;
    const Refresh& refresh;
};

std::string settings(const Recipe& recipe) { return nlohmann::json(recipe.settings).dump(); }

Response identity(const Context& context, const Upcoming& trial) {
    Response row;
    row.rowId = fmt::format("{}-{}-{}", context.session.participant, context.session.number,
                            trial.index);
    row.studyId = context.study.protocol.name;
    row.participantId = context.session.participant;
    row.sessionId = fmt::format("{}", context.session.number);
    row.simulated = context.session.simulated;
    row.slotId = context.assignment.slot;
    row.squareId = context.assignment.square;
    row.squareRow = context.assignment.row;
    row.pairsReversed = context.assignment.reversed;
    row.trialIndex = trial.index;
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
    row.firstIs = reversed ? "b" : "a";
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

Response makeRow(const Context& context, const Upcoming& trial, const TrialRecord& record) {
    Response row = identity(context, trial);
    addCondition(row, context.study.pair(trial.condition), trial.reversed);
    addTiming(row, record, context.refresh);
    addAnswer(row, record);
    addProvenance(row, context.study.protocol);
    return row;
}

// True when answered, false when the person left. A picture is shown, then all that arrived while
// it was on its way is handled, and only then does the machine learn that it came on: so a key
// pressed before it cannot be taken for an answer to it.
bool play(TrialMachine& machine, Observer& observer, Recorder& recorder, int trial,
          const std::string& condition) {
    for (;;) {
        switch (machine.next()) {
        case TrialMachine::Next::journal:
            recorder.trialStarted(trial, condition);
            machine.journalled();
            break;
        case TrialMachine::Next::present: {
            const double time = observer.show(machine.screen());
            for (const Event& event : observer.events(false))
                machine.handle(event);
            machine.shown(time);
            break;
        }
        case TrialMachine::Next::wait:
            for (const Event& event : observer.events(true))
                machine.handle(event);
            break;
        case TrialMachine::Next::answered:
            return true;
        case TrialMachine::Next::left:
            return false;
        }
    }
}

ordered_json orderOf(const Study& study, const Assignment& assignment) {
    ordered_json order = ordered_json::array();
    for (const int condition : assignment.order)
        order.push_back(study.pair(condition).condition);
    return order;
}

ordered_json circumstances(const Context& context, const Observer& observer) {
    const Protocol& protocol = context.study.protocol;
    ordered_json sidecar = {
        {"study", protocol.name},
        {"protocol", protocol.path.string()},
        {"protocol_sha256", protocol.sha256},
        {"stimuli", context.study.manifest.folder.string()},
        {"participant", context.session.participant},
        {"session", context.session.number},
        {"simulated", context.session.simulated},
        {"slot", context.assignment.slot},
        {"square", context.assignment.square},
        {"square_row", context.assignment.row},
        {"pairs_reversed", context.assignment.reversed},
        {"order", orderOf(context.study, context.assignment)},
        {"protocol_seed", protocol.seed},
        {"grey", protocol.trial.grey},
        {"mask_s", protocol.trial.mask},
        {"refresh_hz", context.refresh.hz},
        {"timestamp_source", context.refresh.source},
        {"timing_doubt", context.refresh.doubt},
        {"app_version", version()},
        {"git_commit", commit()},
        {"machine", machineName()},
        {"system", systemName()},
        {"started", utcNow()},
        {"ended", nullptr},
        {"end_reason", "running, or crashed"},
    };
    observer.describe(sidecar);
    return sidecar;
}

ordered_json spell(const IntervalSummary& summary) {
    return {{"count", summary.count},
            {"mean_ms", 1000 * summary.mean},
            {"deviation_ms", 1000 * summary.deviation},
            {"least_ms", 1000 * summary.least},
            {"most_ms", 1000 * summary.most},
            {"histogram_tenths_of_a_refresh", summary.histogram}};
}

struct Played {
    bool completed = false;
    std::vector<double> maskIntervals; // of all trials
};

Played playAll(const Context& context, Observer& observer, Recorder& recorder) {
    Played played;
    const auto& order = context.assignment.order;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Upcoming trial{static_cast<int>(i) + 1, static_cast<int>(order.size()), order[i],
                             context.assignment.reversed};
        TrialMachine machine(context.study.protocol.trial, context.refresh.hz);
        observer.prepare(trial);
        if (!play(machine, observer, recorder, trial.index,
                  context.study.pair(trial.condition).condition))
            return played;
        recorder.record(makeRow(context, trial, machine.record()));
        const auto& intervals = machine.record().maskIntervals;
        played.maskIntervals.insert(played.maskIntervals.end(), intervals.begin(), intervals.end());
    }
    played.completed = true;
    return played;
}

} // namespace

bool runSession(const Study& study, const DataFolder& folder, const SessionId& session,
                Observer& observer) {
    folder.prepare();
    Ledger ledger(folder.ledger());
    Claim claim(ledger, session);
    const Assignment assignment =
        assign(study.protocol.ordering.scheme, static_cast<int>(study.protocol.conditions.size()),
               study.protocol.seed, claim.slot());
    const Refresh refresh = observer.refresh();
    const Context context{study, session, assignment, refresh};
    Recorder recorder(folder, session, claim.slot());
    ordered_json sidecar = circumstances(context, observer);
    writeFile(folder.sidecar(session), sidecar.dump(2) + "\n");

    const Played played =
        observer.instruct() ? playAll(context, observer, recorder) : Played{};
    const std::string reason = played.completed ? "completed" : "left before the last trial";
    recorder.end(reason);
    if (played.completed)
        claim.complete();
    sidecar["ended"] = utcNow();
    sidecar["end_reason"] = reason;
    sidecar["mask_intervals"] = spell(summarise(played.maskIntervals, refresh.hz));
    writeFile(folder.sidecar(session), sidecar.dump(2) + "\n");
    if (played.completed)
        observer.thank();
    return played.completed;
}

} // namespace obscura
