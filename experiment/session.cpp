#include "experiment/session.h"

#include "base/files.h"
#include "experiment/continuity.h"
#include "experiment/page_run.h"
#include "experiment/play.h"
#include "experiment/recorder.h"
#include "experiment/row.h"
#include "experiment/selection.h"
#include "experiment/sidecar.h"
#include "experiment/signals.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace obscura {

using nlohmann::ordered_json;

namespace {

int hastyPressesOf(const TrialRecord& record) {
    int sum = 0;
    for (const PhaseRecord& phase : record.phases)
        sum += phase.hastyPresses;
    return sum;
}

// All trials that are left, or those until the person left: true when all were answered. Adds to
// the intervals of counted phases.
bool playAll(const Context& context, const BrokenSession& before, Observer& observer,
             Recorder& recorder, std::vector<double>& intervals) {
    const Protocol& protocol = context.study.protocol;
    const std::vector<Phase> phases = phasesOf(protocol.trial);
    const int count = longest(protocol);
    std::vector<PastTrial> history = before.history;
    for (int index = before.trials + 1;
         const auto planned = next(protocol, context.assignment.slot, history);) {
        if (planned->kind == PlannedTrial::Kind::rest) {
            if (!observer.rest())
                return false;
            history.push_back({*planned, {}, false});
            continue;
        }
        const Upcoming trial = upcoming(protocol, *planned, index++, count);
        TrialMachine machine(phases, static_cast<int>(trial.order.size()), context.refresh.hz,
                             protocol.keys);
        observer.prepare(trial);
        if (!play(machine, observer, [&] {
                recorder.trialStarted(trial.index,
                                      context.study.condition(trial.planned.condition).condition);
            }))
            return false;
        recorder.finished(trial.index, linesOf(context, trial, machine.record()));
        history.push_back(remember(phases, trial, machine.record()));
        if (const int hasty = hastyPressesOf(machine.record()))
            recorder.hastyPresses(trial.index, hasty);
        for (const PhaseRecord& phase : machine.record().phases)
            intervals.insert(intervals.end(), phase.intervals.begin(), phase.intervals.end());
    }
    return true;
}

// Of what stopped the session, which may be that nothing can be written any more.
void noteStop(Recorder& recorder, const std::string& why) {
    try {
        recorder.end("stopped: " + why);
    } catch (const std::exception&) {
    }
}

// What goes on after what was before; nothing was, for a new session.
bool run(const Study& study, const DataFolder& folder, const BrokenSession& before,
         Observer& observer) {
    throwIfEnded();
    folder.prepare();
    const SessionId& session = before.session;
    const bool resumed = before.slot > 0;
    Ledger ledger(folder.ledger());
    std::optional<SlotClaim> claim;
    const std::string designSha256 = sha256(study.design());
    if (resumed)
        claim.emplace(ledger, before.slot, session, designSha256);
    else if (!session.rehearsal)
        claim.emplace(ledger, session, designSha256,
                      session.simulated ? highestSlot : study.protocol.ordering.participants);
    if (claim)
        keepDesign(folder, study);
    const Assignment assignment = assign(study.protocol, claim ? claim->slot() : 1);
    const Refresh refresh = observer.refresh();
    const Context context{study, session, assignment, refresh, designSha256};
    const bool pairs = pairPhasesOf(study.protocol.trial).has_value();
    Recorder recorder = resumed ? Recorder::resume(folder, before, pairs)
                                : Recorder(folder, session, assignment.slot, pairs);
    ordered_json sidecar = circumstances(context, observer);
    if (resumed)
        sidecar = continued(folder.sidecar(session), sidecar, before);
    writeFile(folder.sidecar(session), sidecar.dump(2) + "\n");

    bool completed = false;
    std::string reason = "left before the last trial";
    std::vector<double> intervals;
    std::optional<EndedBySignal> ended;
    try {
        const PagesEnd entered = runPages(context, "before", before.pages, observer, recorder);
        if (!entered.endedBy.empty())
            reason = fmt::format("{}\"{}\"", endedByAnswer, entered.endedBy);
        completed = entered.finished && observer.instruct() &&
                    playAll(context, before, observer, recorder, intervals);
        if (completed) {
            reason = "completed"; // whatever comes of the pages after
            runPages(context, "after", before.pages, observer, recorder);
        }
    } catch (const EndedBySignal& signal) {
        ended = signal;
        if (!completed)
            reason = "ended by " + signal.name();
    } catch (const std::exception& error) {
        noteStop(recorder, error.what());
        throw;
    }
    recorder.end(reason);
    addOutcome(sidecar, reason, intervals, refresh.hz, observer);
    writeFile(folder.sidecar(session), sidecar.dump(2) + "\n");
    if (completed && claim)
        claim->complete();
    if (ended)
        throw EndedBySignal{*ended};
    if (completed)
        observer.thank();
    return completed;
}

} // namespace

bool runSession(const Study& study, const DataFolder& folder, const SessionId& session,
                Observer& observer) {
    return run(study, folder, {session, 0, {}, 0, {}, {}}, observer);
}

bool resumeSession(const Study& study, const DataFolder& folder, const BrokenSession& broken,
                   Observer& observer) {
    return run(study, folder, broken, observer);
}

} // namespace obscura
