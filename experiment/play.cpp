#include "experiment/play.h"

#include "experiment/signals.h"

#include <algorithm>

namespace obscura {

Upcoming upcoming(const Protocol& protocol, const PlannedTrial& planned, int index, int count) {
    Upcoming trial{index, count, planned, {}};
    for (const int role : planned.roles)
        trial.order.push_back(protocol.trial.order[static_cast<std::size_t>(role)]);
    return trial;
}

// A picture is shown, then all that arrived while it was on its way is handled, and only then does
// the machine learn that it came on: so a key pressed before it cannot be taken for an answer to
// it. A picture that only replaces one of the same screen has been on: what arrives meanwhile is an
// answer to it, and may lead to the next.
bool play(TrialMachine& machine, Observer& observer, const std::function<void()>& exposing) {
    for (;;) {
        throwIfEnded();
        switch (machine.next()) {
        case TrialMachine::Next::journal:
            exposing();
            machine.journalled();
            break;
        case TrialMachine::Next::present: {
            const bool anew = machine.isOn();
            const double time = observer.show(machine);
            if (anew)
                machine.shown(time);
            for (const Event& event : observer.events(false))
                machine.handle(event);
            if (!anew)
                machine.shown(time);
            break;
        }
        case TrialMachine::Next::wait:
            for (const Event& event : observer.events(true))
                machine.handle(event);
            break;
        case TrialMachine::Next::finished:
            return true;
        case TrialMachine::Next::left:
            return false;
        }
    }
}

PastTrial remember(const std::vector<Phase>& phases, const Upcoming& trial,
                   const TrialRecord& record) {
    PastTrial past{trial.planned, {}, record.interrupted};
    for (const FormAnswer& answer : record.answers)
        past.answers[answer.name] = answer.value;
    for (const Phase& phase : phases)
        for (const Question& question : phase.questions)
            if (question.images)
                past.answers[question.name] = trial.role(past.answers[question.name]);
    return past;
}

} // namespace obscura
