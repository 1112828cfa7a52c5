#include "experiment/session.h"

#include "experiment/recorder.h"
#include "experiment/row.h"
#include "experiment/sidecar.h"
#include "protocols/files.h"

#include <nlohmann/json.hpp>

namespace obscura {

using nlohmann::ordered_json;

namespace {

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
        if (const int hasty = machine.record().hastyPresses)
            recorder.hastyPresses(trial.index, hasty);
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

    const Played played = observer.instruct() ? playAll(context, observer, recorder) : Played{};
    const std::string reason = played.completed ? "completed" : "left before the last trial";
    recorder.end(reason);
    if (played.completed)
        claim.complete();
    addOutcome(sidecar, reason, played.maskIntervals, refresh.hz);
    writeFile(folder.sidecar(session), sidecar.dump(2) + "\n");
    if (played.completed)
        observer.thank();
    return played.completed;
}

} // namespace obscura
