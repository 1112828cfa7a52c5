#pragma once

#include "experiment/form.h"
#include "experiment/timing_count.h"
#include "gl/input.h"
#include "protocols/reader/trial.h"

#include <optional>
#include <vector>

namespace obscura {

// What can be on the screen during a trial: one of its phases, counted from 0, or the page that
// asks whether to end the session.
using Screen = int;
constexpr Screen leaveScreen = -1;

// What the person did, in seconds on the session's clock.
struct Event {
    enum class Kind { press, release, text, option, focusLost };

    Kind kind = Kind::press;
    double time = 0;
    gl::Key key{};
    int option = 0;           // clicked with the mouse: which of the page's targets, from 1
    double share = 0;         // how far from that target's left side, 0 ... 1
    std::uint32_t symbol = 0; // text: a Unicode code point
};

// Of the page that asks whether to leave: 1 (also left) or 2 (also right); 0 for other keys.
int optionOf(gl::Key key);

// What a phase yields. Times in seconds; its onset is on the session's clock; it is on view until
// the next comes on, the last until it is ended, pauses left out.
struct PhaseRecord {
    bool shown = false;
    double onset = 0, view = 0;
    int framesPlanned = 0, framesShown = 0, missedFrames = 0; // of a counted phase
    int earlyPresses = 0; // keys pressed from when it was wanted until the next was on, and dropped
    int hastyPresses = 0; // of Space, before it had been on view for `atLeast`
    bool interrupted = false;      // the keyboard was lost, or Escape pressed, while it was on view
    bool timedOut = false;         // questions that ended unanswered
    std::vector<double> intervals; // between refreshes
};

struct TrialRecord {
    std::vector<PhaseRecord> phases;
    std::vector<FormAnswer> answers; // in the order of the phases
    bool interrupted = false;        // a phase was, from the first image to the last
};

// One trial as a machine without a clock, screen or keyboard of its own: it is told what was shown
// when and what was pressed when, and says what to do next. It goes through the phases in order.
// Nothing shown is shown again and no answer is taken back.
//
// A key counts only for a phase that is already on the screen, and only when it was up before:
// what is pressed in a locked phase is counted and dropped, even Escape; a key held down repeats
// nothing. Space does not end a phase that has been on view for less than `atLeast`: two taps in a
// row would lose it for good. Escape elsewhere asks whether to end the session. If that, or a lost
// focus, broke the exposure of an image, the trial goes on but is marked interrupted: a half-seen
// pair cannot be unseen.
//
// All memory is taken when it is made: until a question is answered, nothing is allocated.
class TrialMachine {
  public:
    enum class Next {
        journal, // write down that the exposure begins, then call journalled(): before the first
                 // image, and before what leads to it by the clock, which writing must not hold up
        present, // show screen(), then call shown()
        wait,    // sleep until there is an event
        finished,
        left, // the session is to end; there is no answer
    };

    // `images`: how many places the trial's order has.
    TrialMachine(std::vector<Phase> phases, int images, double refreshHz, Keys keys = {});

    Next next() const;
    Screen screen() const { return screen_; }
    // Of a phase that asks, what its page shows.
    const Form* form() const;
    // Of a phase that shows images in turn, whose turn is next, from 0.
    int alternation() const;
    const TrialRecord& record() const { return record_; }

    void journalled() { journalled_ = true; }
    // Whether screen() has been shown already, and is only to be shown anew.
    bool isOn() const { return visible_ == screen_; }
    // screen() came on at `time`; a counted phase is shown anew at every refresh. Events that
    // arrived before it first came on must have been handled before; those that arrived while it
    // was shown anew are handled afterwards, because they may lead to another screen.
    void shown(double time);
    void handle(const Event& event);

  private:
    const Phase& phase(Screen screen) const { return phases_[static_cast<std::size_t>(screen)]; }
    PhaseRecord& recordOf(Screen screen) {
        return record_.phases[static_cast<std::size_t>(screen)];
    }
    bool counted(std::optional<Screen> screen) const;
    bool locked(std::optional<Screen> screen) const;
    bool exposing(Screen screen) const;
    Form* asked();
    void advance(double time);
    void go(Screen screen);
    void enter(double time);
    void noteCount();
    std::optional<Screen> droppedIn(double time) const;
    void press(gl::Key key, double time);
    void end(double time);
    void answer(Form::Effect effect, double time);
    void leave(int option);
    void askToLeave();
    void interrupt();
    double viewed(Screen screen, double time) const;

    std::vector<Phase> phases_;
    double refreshHz_;
    Keys keys_;
    TrialRecord record_;

    Screen screen_ = 0;             // wanted
    std::optional<Screen> visible_; // the one on the screen now,
    double since_ = 0;              // and since when
    std::optional<Screen> before_;  // the one before it
    bool pending_ = true;           // screen_ is not on the screen yet, or has changed
    bool journalled_ = false;
    bool left_ = false;
    Screen paused_ = 0; // what the page that asks returns to
    Screen firstImage_, lastImage_, journalAt_;
    std::vector<std::optional<Form>> forms_; // of the phases that ask
    std::vector<gl::Key> held_;

    // Of the counted phase on the screen, since it came there; and what was counted before a pause.
    RefreshCount count_;
    int framesBefore_ = 0, missedBefore_ = 0;
};

} // namespace obscura
