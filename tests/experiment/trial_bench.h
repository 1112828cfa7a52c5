#pragma once

#include "experiment/trial.h"

#include <gtest/gtest.h>

namespace obscura::test {

constexpr double frame = 1 / 60.0;

// The phases of the shorthand.
constexpr Screen startPage = 0, firstImage = 1, mask = 2, secondImage = 3, question = 4;

// Plays the runner's part: a clock, a screen that shows what is asked for at the next refresh, and
// fingers.
class Bench {
  public:
    explicit Bench(double seconds = 2, double minimumView = 0)
        : Bench(phasesOf({seconds, 128, minimumView, {}})) {}
    explicit Bench(const std::vector<Phase>& phases, int images = 2)
        : machine(phases, images, 60) {}

    TrialMachine machine;
    double now = 10;
    int maskShown = 0;

    void down(gl::Key key) { machine.handle({Event::Kind::press, now, key}); }
    void up(gl::Key key) { machine.handle({Event::Kind::release, now, key}); }
    void tap(gl::Key key) { down(key), up(key); }
    void click(int option, double share = 0.5) {
        machine.handle({Event::Kind::option, now, {}, option, share});
    }
    void type(const std::string& letters) {
        for (const char letter : letters)
            machine.handle({Event::Kind::text, now, {}, 0, 0, static_cast<std::uint32_t>(letter)});
    }
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
        maskShown += machine.screen() == mask;
        machine.shown(now);
        return true;
    }
    void settle() {
        while (step()) {
        }
    }

    void toFirst() { settle(), tap(gl::Key::space), settle(); }
    void toMask() { toFirst(), look(3), tap(gl::Key::space); }
    void toSecond() { toMask(), settle(); }
    void toQuestion() { toSecond(), look(2), tap(gl::Key::space), settle(); }
    const TrialRecord& record() const { return machine.record(); }
    const PhaseRecord& phase(Screen screen) const {
        return record().phases.at(static_cast<std::size_t>(screen));
    }
    // The answer's value; "" while there is none.
    std::string answer(std::size_t index = 0) const {
        return index < record().answers.size() ? record().answers[index].value : "";
    }
    int hastyPresses() const {
        int sum = 0;
        for (const PhaseRecord& each : record().phases)
            sum += each.hastyPresses;
        return sum;
    }
};

} // namespace obscura::test
