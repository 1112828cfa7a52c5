#include "experiment/trial.h"

#include "experiment/refresh.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

// Bridges et al. 2020 and PsychoPy: an interval above 1.2 refreshes is a missed one.
constexpr double missedInterval = 1.2;

} // namespace

int optionOf(gl::Key key) {
    switch (key) {
    case gl::Key::one:
    case gl::Key::keypadOne:
    case gl::Key::left:
        return 1;
    case gl::Key::two:
    case gl::Key::keypadTwo:
    case gl::Key::right:
        return 2;
    default:
        return 0;
    }
}

TrialMachine::TrialMachine(const Trial& timeline, double refreshHz)
    : minimumView_(timeline.minimumView), refreshHz_(refreshHz) {
    record_.maskFramesPlanned = maskRefreshes(timeline.mask, refreshHz);
}

TrialMachine::Next TrialMachine::next() const {
    if (left_)
        return Next::left;
    if (record_.chosen)
        return Next::answered;
    if (screen_ == Screen::first && !journalled_)
        return Next::journal;
    return pending_ || screen_ == Screen::mask ? Next::present : Next::wait;
}

void TrialMachine::shown(double time) {
    if (screen_ == Screen::mask || visible_ == Screen::mask)
        countRefresh(time);
    if (visible_ != screen_)
        enter(time);
    pending_ = false;
    if (screen_ == Screen::mask && refreshes() >= record_.maskFramesPlanned)
        go(Screen::second);
}

void TrialMachine::enter(double time) {
    if (visible_)
        viewed_[static_cast<std::size_t>(*visible_)] += time - since_;
    const bool again = viewed_[static_cast<std::size_t>(screen_)] > 0;
    visible_ = screen_;
    since_ = time;

    record_.view1 = viewed(Screen::first, time);
    record_.mask = viewed(Screen::mask, time);
    record_.view2 = viewed(Screen::second, time);
    if (again)
        return;
    if (screen_ == Screen::first)
        record_.onset1 = time;
    if (screen_ == Screen::second)
        record_.onset2 = time;
    if (screen_ == Screen::question)
        record_.questionOnset = time;
}

// Each swap of a synchronised display lasts one refresh, or more when the next comes late. The
// backlog adds up by how much intervals were too long, less what later ones were too short: a
// stamp that is itself late cancels out, a missed refresh stays. Intervals that are short from the
// start (a driver that queues the first swaps) do not make it negative.
void TrialMachine::countRefresh(double time) {
    if (maskSwaps_ > 0) {
        const double interval = time - lastRefresh_;
        record_.maskIntervals.push_back(interval);
        record_.missedFrames += interval * refreshHz_ > missedInterval;
        backlog_ = std::max(0.0, backlog_ + interval * refreshHz_ - 1);
    }
    maskSwaps_ += screen_ == Screen::mask;
    lastRefresh_ = time;
    record_.maskFramesShown = refreshes();
}

int TrialMachine::refreshes() const { return maskSwaps_ + static_cast<int>(std::lround(backlog_)); }

void TrialMachine::handle(const Event& event) {
    if (event.kind == Event::Kind::release) {
        held_.erase(event.key);
        return;
    }
    if (event.kind == Event::Kind::focusLost) {
        record_.interrupted |= exposing();
        return;
    }
    const bool fresh = event.kind != Event::Kind::press || held_.insert(event.key).second;
    if (!fresh || next() == Next::answered || next() == Next::left)
        return;
    if (masked(event.time))
        record_.earlyPresses += event.kind == Event::Kind::press;
    else if (pending_ || event.time < since_)
        return;
    else if (event.kind == Event::Kind::option)
        choose(event.option, event.time);
    else
        press(event.key, event.time);
}

// Between the press that ends image 1 and the onset of image 2.
bool TrialMachine::masked(double time) const {
    return screen_ == Screen::mask || (screen_ == Screen::second && visible_ == Screen::mask) ||
           (visible_ == Screen::second && time < record_.onset2);
}

bool TrialMachine::exposing() const {
    return screen_ == Screen::first || screen_ == Screen::mask || screen_ == Screen::second;
}

void TrialMachine::press(gl::Key key, double time) {
    if (key == gl::Key::escape)
        askToLeave();
    else if (key == gl::Key::space)
        pressSpace(time);
    else if (screen_ != Screen::start)
        choose(optionOf(key), time);
}

void TrialMachine::pressSpace(double time) {
    const bool image = screen_ == Screen::first || screen_ == Screen::second;
    if (image && viewed(screen_, time) < minimumView_)
        ++record_.hastyPresses;
    else if (screen_ == Screen::start)
        go(Screen::first);
    else if (screen_ == Screen::first)
        go(Screen::mask);
    else if (screen_ == Screen::second)
        go(Screen::question);
}

void TrialMachine::choose(int option, double time) {
    if (option == 0)
        return;
    if (screen_ == Screen::start)
        go(Screen::first); // its only option
    if (screen_ == Screen::question) {
        record_.decision = viewed(Screen::question, time);
        record_.chosen = option;
    }
    if (screen_ == Screen::leave) {
        left_ = option == 2;
        go(paused_);
    }
}

void TrialMachine::askToLeave() {
    if (screen_ == Screen::leave) {
        go(paused_);
        return;
    }
    record_.interrupted |= exposing();
    paused_ = screen_;
    go(Screen::leave);
}

void TrialMachine::go(Screen screen) {
    screen_ = screen;
    pending_ = true;
}

double TrialMachine::viewed(Screen screen, double time) const {
    const double now = visible_ == screen ? time - since_ : 0;
    return viewed_[static_cast<std::size_t>(screen)] + now;
}

} // namespace obscura
