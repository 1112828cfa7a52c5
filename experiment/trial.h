#pragma once

#include "gl/input.h"
#include "protocols/reader/protocol.h"

#include <array>
#include <optional>
#include <set>
#include <vector>

namespace obscura {

// What can be on the screen during a trial. `leave` asks whether to end the session.
enum class Screen { start, first, mask, second, question, leave };

// What the person did, in seconds on the session's clock.
struct Event {
    enum class Kind { press, release, option, focusLost };

    Kind kind = Kind::press;
    double time = 0;
    gl::Key key{};
    int option = 0; // clicked with the mouse: 1 or 2
};

// The option that a key stands for: 1 (also left) or 2 (also right); 0 for none.
int optionOf(gl::Key key);

// What a trial yields. Times in seconds; onsets on the session's clock; a view lasts as long as
// its picture was on the screen, pauses left out.
struct TrialRecord {
    double onset1 = 0, view1 = 0, mask = 0, onset2 = 0, view2 = 0, questionOnset = 0, decision = 0;
    int maskFramesPlanned = 0, maskFramesShown = 0, missedFrames = 0;
    int earlyPresses = 0; // keys pressed between the end of image 1 and the onset of image 2
    int hastyPresses = 0; // of Space, before its image had been on the screen for minimumView
    bool interrupted = false;
    int chosen = 0;                    // 1 or 2; 0 until answered
    std::vector<double> maskIntervals; // between its refreshes
};

// One trial as a machine without a clock, screen or keyboard of its own: it is told what was shown
// when and what was pressed when, and says what to do next. The participant starts the pair; image
// 1 until Space; the mask for a fixed number of refreshes; image 2 until Space; the question until
// an answer. Nothing shown is shown again and no answer is taken back.
//
// A key counts only for a picture that is already on the screen, and only when it was up before:
// what is pressed in the mask is counted and dropped, even Escape; a key held down repeats nothing.
// Space does not end an image that has been on the screen for less than minimumView: two taps in a
// row would lose it for good. Escape elsewhere asks whether to end the session. If that, or a lost
// focus, broke the exposure of an image, the trial goes on but is marked interrupted: a half-seen
// pair cannot be unseen.
class TrialMachine {
  public:
    enum class Next {
        journal, // write down that the exposure begins, then call journalled()
        present, // show screen(), then call shown()
        wait,    // sleep until there is an event
        answered,
        left, // the session is to end; there is no answer
    };

    TrialMachine(const Trial& timeline, double refreshHz);

    Next next() const;
    Screen screen() const { return screen_; }
    const TrialRecord& record() const { return record_; }

    void journalled() { journalled_ = true; }
    // screen() came on at `time`; the mask is shown anew at every refresh. Events that arrived
    // before must have been handled before.
    void shown(double time);
    void handle(const Event& event);

  private:
    void go(Screen screen);
    void enter(double time);
    void countRefresh(double time);
    int refreshes() const;
    bool masked(double time) const;
    bool exposing() const;
    void press(gl::Key key, double time);
    void pressSpace(double time);
    void choose(int option, double time);
    void askToLeave();
    double viewed(Screen screen, double time) const;

    double minimumView_;
    double refreshHz_;
    TrialRecord record_;

    Screen screen_ = Screen::start; // wanted
    std::optional<Screen> visible_; // the one on the screen now,
    double since_ = 0;              // and since when
    bool pending_ = true;           // screen_ is not on the screen yet
    bool journalled_ = false;
    bool left_ = false;
    Screen paused_ = Screen::start;  // what `leave` returns to
    std::array<double, 6> viewed_{}; // per screen, without the visible one
    std::set<gl::Key> held_;

    int maskSwaps_ = 0;
    double lastRefresh_ = 0;
    double backlog_ = 0; // refreshes by which the swaps of the mask lag behind
};

} // namespace obscura
