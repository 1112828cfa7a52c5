#pragma once

#include "base/random.h"
#include "experiment/eyes.h"
#include "experiment/observer.h"
#include "experiment/trial.h"
#include "gl/input.h"
#include "protocols/reader/protocol.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What a simulated participant does: presses a key and lets it go, or types.
struct Deed {
    double time = 0;   // on the clock by which it is told what it sees
    gl::Key key{};     // where nothing is typed
    std::string typed; // ASCII
};

// The model, for dry runs and power studies; docs/measurement.md has it in words. The probability
// of choosing the second image is that of preferring the member shown second (the protocol's
// choose_b, or one minus it), plus the position bias, within [0, 1]; or, with stimuli to look at,
// the images are answered by their predicted JOD (Eyes). Looking and deciding take
// ex-Gaussian times. The same seed and participant always do the same, whatever the clock.
class SimulatedParticipant {
  public:
    // `seen`: the stimuli; null for one without eyes.
    SimulatedParticipant(const Protocol& protocol, std::uint64_t seed, const std::string& name,
                         const Manifest* seen = nullptr);

    void describe(nlohmann::ordered_json& sidecar) const;
    void prepare(const Upcoming& trial);
    void preparePage(const Phase& page); // before or after the trials
    // The trial's screen is on since then, or what it shows has changed. Unless it is about to do
    // something on that screen already, the participant decides what.
    void sees(const TrialMachine& trial, double time);
    // When it will do something; nothing in a locked phase.
    std::optional<double> next() const;
    // That, when its time has come.
    std::optional<Deed> take(double time);
    double reading(); // seconds for which it looks at a page outside a trial

  private:
    const Phase& phaseOn(Screen screen) const {
        return page_ ? *page_ : phases_[static_cast<std::size_t>(screen)];
    }
    gl::Key keyOf(const Question& question, int option) const;
    Deed decide(const TrialMachine& trial, const Phase& phase);
    Deed answer(const Form& form);
    double draw(const ExGaussian& time);

    const Protocol& protocol_;
    const std::vector<Phase> phases_;
    std::uint64_t seed_;
    Random random_, pages_; // pages outside a trial leave what it does in trials as it is
    std::optional<Eyes> eyes_;
    double chooseSecond_ = 0.5;
    const Phase* page_ = nullptr; // outside trials
    std::optional<Deed> deed_;
    Screen screen_ = 0; // where
};

// With a clock of its own that ticks 60 times a second, and nothing to look at.
class SimulatedObserver : public Observer {
  public:
    SimulatedObserver(const Protocol& protocol, std::uint64_t seed, const std::string& participant,
                      const Manifest* seen = nullptr)
        : participant_(protocol, seed, participant, seen) {}

    Refresh refresh() const override;
    void describe(nlohmann::ordered_json& sidecar) const override {
        participant_.describe(sidecar);
    }
    bool instruct() override { return true; }
    void prepare(const Upcoming& trial) override { participant_.prepare(trial); }
    void preparePage(const Phase& page) override { participant_.preparePage(page); }
    double show(const TrialMachine& trial) override; // at the next refresh
    const std::vector<Event>& events(bool wait) override;
    bool rest() override { return true; }
    void thank() override {}
    void decline() override {}

  private:
    SimulatedParticipant participant_;
    const TrialMachine* trial_ = nullptr; // what it shows
    double clock_ = 0;
    std::vector<Event> events_;
};

} // namespace obscura
