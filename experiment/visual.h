#pragma once

#include "experiment/presenter.h"
#include "experiment/simulated.h"
#include "gl/fingers.h"

#include <cstdint>
#include <string>
#include <vector>

namespace obscura {

// A simulated participant at the real window: sees what the presenter shows, and presses keys that
// come back to it as those of people do. Does the same as a SimulatedObserver of the same name and
// seed; only the times are those of the display. While another window has the keyboard, it waits.
class VisualObserver : public Observer {
  public:
    VisualObserver(Presenter& presenter, const Protocol& protocol, std::uint64_t seed,
                   const std::string& participant, const Manifest* seen = nullptr);
    ~VisualObserver() override;
    VisualObserver(const VisualObserver&) = delete;
    VisualObserver& operator=(const VisualObserver&) = delete;

    Refresh refresh() const override { return presenter_.refresh(); }
    void describe(nlohmann::ordered_json& sidecar) const override;
    void describeOutcome(nlohmann::ordered_json& sidecar) const override {
        presenter_.describeOutcome(sidecar);
    }
    bool instruct() override;
    void prepare(const Upcoming& trial) override;
    void preparePage(const Phase& page) override;
    double show(const TrialMachine& trial) override;
    const std::vector<Event>& events(bool wait) override;
    bool rest() override;
    void thank() override;
    void decline() override;

  private:
    double attend();
    void act(const Deed& deed);
    void turnPage();

    Presenter& presenter_;
    SimulatedParticipant participant_;
    gl::Key go_; // ends a page
    gl::Fingers fingers_;
    const TrialMachine* trial_ = nullptr; // null on pages outside a trial
    double turn_ = 0; // when it presses Space there; 0: not seen yet; infinity: it has
    int coming_ = 0;  // keys that it pressed and whose releases have not come back yet
};

} // namespace obscura
