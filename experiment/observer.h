#pragma once

#include "base/random.h"
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

    virtual bool instruct() = 0; // false when the person leaves instead of beginning
    virtual void prepare(const Upcoming& trial) = 0;
    // The same for a page before or after the trials, which is then screen 0.
    virtual void preparePage(const Phase& page) = 0;
    // Shows the screen that the prepared trial wants; the time at which it came on.
    virtual double show(const TrialMachine& trial) = 0;
    // What the person has done since; with `wait`, sleeps until there is something.
    virtual std::vector<Event> events(bool wait) = 0;
    virtual bool rest() = 0; // between trials; false when the person leaves instead of going on
    virtual void thank() = 0;
    virtual void decline() = 0; // says that an answer has ended the session before its trials
};

// The model, for dry runs and power studies; docs/measurement.md has it in words. The probability
// of choosing the second image is that of preferring the member shown second (the protocol's
// choose_b, or one minus it), plus the position bias, within [0, 1]. Looking and deciding take
// ex-Gaussian times. The same seed and participant always do the same.
class SimulatedObserver : public Observer {
  public:
    SimulatedObserver(const Protocol& protocol, std::uint64_t seed, const std::string& participant);

    Refresh refresh() const override;
    void describe(nlohmann::ordered_json& sidecar) const override;
    bool instruct() override { return true; }
    void prepare(const Upcoming& trial) override;
    void preparePage(const Phase& page) override { page_ = &page; }
    double show(const TrialMachine& trial) override; // at the next refresh of a 60 Hz clock
    std::vector<Event> events(bool wait) override;
    bool rest() override { return true; }
    void thank() override {}
    void decline() override {}

  private:
    std::vector<Event> press(gl::Key key, double after);
    std::vector<Event> answer(const Form& form);
    std::vector<Event> type(const Question& question, double after);
    double draw(const ExGaussian& time);

    const Protocol& protocol_;
    const std::vector<Phase> phases_;
    std::uint64_t seed_;
    Random random_;
    double chooseSecond_ = 0.5;
    const Phase* page_ = nullptr;         // outside trials
    const TrialMachine* trial_ = nullptr; // what it shows
    double clock_ = 0;
};

} // namespace obscura
