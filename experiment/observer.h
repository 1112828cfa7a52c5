#pragma once

#include "experiment/refresh.h"
#include "experiment/selection.h"
#include "experiment/study.h"
#include "experiment/trial.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace obscura {

// A trial about to be run.
struct Upcoming {
    int index = 0, count = 0; // which of how many, from 1
    PlannedTrial planned;
    std::vector<std::string> order; // the roles at the places 1, 2 and so on

    // The role of an image that a phase names by its place in the order, or by its role.
    const std::string& role(const std::string& image) const;
};

// One who is shown things and answers: a person before a display (Presenter), or a stated model of
// one with a clock of its own. Both go through the same session, trial machine and recorder.
class Observer {
  public:
    virtual ~Observer() = default;

    virtual Refresh refresh() const = 0;
    virtual void describe(nlohmann::ordered_json& sidecar) const = 0; // display, or model
    // What of it is known only at the end.
    virtual void describeOutcome(nlohmann::ordered_json&) const {}

    virtual bool instruct() = 0; // false when the person leaves instead of beginning
    virtual void prepare(const Upcoming& trial) = 0;
    // The same for a page before or after the trials, which is then screen 0.
    virtual void preparePage(const Phase& page) = 0;
    // Shows the screen that the prepared trial wants; the time at which it came on.
    virtual double show(const TrialMachine& trial) = 0;
    // What the person has done since; with `wait`, sleeps until there is something. Valid until the
    // next call.
    virtual const std::vector<Event>& events(bool wait) = 0;
    virtual bool rest() = 0; // between trials; false when the person leaves instead of going on
    virtual void thank() = 0;
    virtual void decline() = 0; // says that an answer has ended the session before its trials
};

} // namespace obscura
