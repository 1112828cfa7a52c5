#include "experiment/visual.h"

#include <algorithm>
#include <limits>

namespace obscura {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double again = 0.1; // seconds until it looks whether the window has the keyboard

} // namespace

VisualObserver::VisualObserver(Presenter& presenter, const Protocol& protocol, std::uint64_t seed,
                               const std::string& participant, const Manifest* seen)
    : presenter_(presenter), participant_(protocol, seed, participant, seen),
      go_(static_cast<gl::Key>(protocol.keys.go.front())) {
    presenter_.whileWaiting([this] { return attend(); });
}

VisualObserver::~VisualObserver() { presenter_.whileWaiting({}); }

void VisualObserver::describe(nlohmann::ordered_json& sidecar) const {
    presenter_.describe(sidecar);
    participant_.describe(sidecar);
}

bool VisualObserver::instruct() {
    turnPage();
    return presenter_.instruct();
}

bool VisualObserver::rest() {
    turnPage();
    return presenter_.rest();
}

void VisualObserver::thank() {
    turnPage();
    presenter_.thank();
}

void VisualObserver::decline() {
    turnPage();
    presenter_.decline();
}

void VisualObserver::turnPage() {
    trial_ = nullptr;
    turn_ = 0;
}

void VisualObserver::prepare(const Upcoming& trial) {
    presenter_.prepare(trial);
    participant_.prepare(trial);
    coming_ = 0; // what ended the page before is of no interest
}

void VisualObserver::preparePage(const Phase& page) {
    presenter_.preparePage(page);
    participant_.preparePage(page);
    coming_ = 0;
}

double VisualObserver::show(const TrialMachine& trial) {
    trial_ = &trial;
    const double time = presenter_.show(trial);
    if (coming_ == 0)
        participant_.sees(trial, time);
    return time;
}

const std::vector<Event>& VisualObserver::events(bool wait) {
    if (!wait)
        attend(); // between two refreshes
    const std::vector<Event>& events = presenter_.events(wait);
    for (const Event& event : events)
        if (event.kind == Event::Kind::release)
            coming_ = std::max(0, coming_ - 1);
    return events;
}

// Does what is due; the seconds until it wants to be asked again.
double VisualObserver::attend() {
    const double now = presenter_.now();
    if (trial_ && coming_ == 0) // otherwise it does not know yet what its keys have done
        participant_.sees(*trial_, now);
    if (!trial_ && turn_ == 0)
        turn_ = now + participant_.reading();
    const double due = !trial_ ? turn_ : coming_ > 0 ? never : participant_.next().value_or(never);
    if (due > now)
        return due - now;
    if (!presenter_.hasKeyboard())
        return again;
    if (trial_)
        act(*participant_.take(now));
    else
        fingers_.tap(go_);
    turn_ = never;
    return never;
}

void VisualObserver::act(const Deed& deed) {
    for (const char letter : deed.typed)
        fingers_.type(letter);
    if (deed.typed.empty())
        fingers_.tap(deed.key);
    coming_ = std::max(1, static_cast<int>(deed.typed.size()));
}

} // namespace obscura
