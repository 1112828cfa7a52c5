#pragma once

#include "experiment/trial.h"

#include <gtest/gtest.h>

namespace obscura::test {

constexpr double frame = 1 / 60.0;

// Plays the runner's part: a clock, a screen that shows what is asked for at the next refresh, and
// fingers.
class Bench {
  public:
    explicit Bench(double mask = 2, double minimumView = 0)
        : machine(Trial{mask, 128, minimumView}, 60) {}

    TrialMachine machine;
    double now = 10;
    int maskShown = 0;

    void down(gl::Key key) { machine.handle({Event::Kind::press, now, key}); }
    void up(gl::Key key) { machine.handle({Event::Kind::release, now, key}); }
    void tap(gl::Key key) { down(key), up(key); }
    void click(int option) { machine.handle({Event::Kind::option, now, {}, option}); }
    void loseFocus() { machine.handle({Event::Kind::focusLost, now}); }
    void look(double seconds) { now += seconds; }

    // One thing the machine asks for other than waiting; false when it waits or has ended.
    bool step(double interval = frame) {
        if (machine.next() == TrialMachine::Next::journal) {
            machine.journalled();
            return true;
        }
        if (machine.next() != TrialMachine::Next::present)
            return false;
        now += interval;
        maskShown += machine.screen() == Screen::mask;
        machine.shown(now);
        return true;
    }
    void settle() {
        while (step()) {
        }
    }
    void settleOn(Screen screen) {
        while (machine.screen() != screen && step()) {
        }
        while (machine.screen() == screen && machine.next() != TrialMachine::Next::wait &&
               screen != Screen::mask && step()) {
        }
        ASSERT_EQ(machine.screen(), screen);
    }

    void toFirst() { settle(), tap(gl::Key::space), settle(); }
    void toMask() { toFirst(), look(3), tap(gl::Key::space); }
    void toSecond() { toMask(), settle(); }
    void toQuestion() { toSecond(), look(2), tap(gl::Key::space), settle(); }
    const TrialRecord& record() const { return machine.record(); }
};

} // namespace obscura::test
