#include "experiment/check.h"

#include "base/error.h"
#include "experiment/pages.h"
#include "experiment/play.h"
#include "experiment/screens.h"
#include "experiment/simulated.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

// A simulated participant who gives up instead of pressing keys for ever.
class Trier : public SimulatedObserver {
  public:
    Trier(const Protocol& protocol, const std::vector<Phase>& phases, int slot)
        : SimulatedObserver(protocol, protocol.seed, fmt::format("S{:02}", slot)), phases_(phases) {
    }

    void prepare(const Upcoming& trial) override {
        SimulatedObserver::prepare(trial);
        keys_ = 0;
    }
    double show(const TrialMachine& trial) override {
        screen_ = trial.screen();
        return SimulatedObserver::show(trial);
    }
    const std::vector<Event>& events(bool wait) override {
        if (wait && ++keys_ > mostKeys)
            throw Error(phases_.at(static_cast<std::size_t>(screen_)).place,
                        fmt::format("expected a phase that ends; a simulated participant has "
                                    "pressed {} keys in this trial, and it goes on",
                                    mostKeys));
        return SimulatedObserver::events(wait);
    }

  private:
    static constexpr int mostKeys = 10000;

    const std::vector<Phase>& phases_;
    int keys_ = 0;
    Screen screen_ = 0;
};

// How many trials a slot has.
int playSlot(const Protocol& protocol, int slot) {
    const std::vector<Phase> phases = phasesOf(protocol.trial);
    Trier observer(protocol, phases, slot);
    std::vector<PastTrial> history;
    int trials = 0;
    while (const auto planned = next(protocol, slot, history)) {
        if (planned->kind == PlannedTrial::Kind::rest) {
            history.push_back({*planned, {}, false});
            continue;
        }
        const Upcoming trial = upcoming(protocol, *planned, ++trials, longest(protocol));
        if (trials > trial.count)
            throw Error(fmt::format("slot {} has more than the {} trials that it should have", slot,
                                    trial.count));
        TrialMachine machine(phases, static_cast<int>(trial.order.size()), observer.refresh().hz,
                             protocol.keys);
        observer.prepare(trial);
        play(machine, observer, [] {});
        history.push_back(remember(phases, trial, machine.record()));
    }
    return trials;
}

} // namespace

std::string checkRuns(const Protocol& protocol, int width, int height) {
    for (const Texts* texts : protocol.languages()) {
        checkShowable(*texts);
        Screens(protocol, *texts, width, height, "").check();
    }
    const int slots = protocol.ordering.participants;
    int fewest = 0, most = 0;
    for (int slot = 1; slot <= slots; ++slot) {
        const int trials = playSlot(protocol, slot);
        fewest = slot == 1 ? trials : std::min(fewest, trials);
        most = std::max(most, trials);
    }
    return fmt::format(
        "{}: {} conditions, {} phases; {} simulated participants reached the end of {} trials; all "
        "fits on {}x{} pixels",
        protocol.name, protocol.conditions.size(), phasesOf(protocol.trial).size(), slots,
        fewest == most ? fmt::format("{}", most) : fmt::format("{} to {}", fewest, most), width,
        height);
}

} // namespace obscura
