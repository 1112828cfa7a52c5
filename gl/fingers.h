#pragma once

#include "gl/input.h"

#include <memory>

struct _XDisplay; // NOLINT(bugprone-reserved-identifier): so Xlib calls it

namespace obscura::gl {

// Presses keys, and moves the mouse, as a hand would (the extension XTEST of the X server): they go
// to whichever window has the keyboard or lies under the cursor, and nothing tells them from
// others. An Error where there is no X server that can.
class Fingers {
  public:
    Fingers();

    void tap(Key key);      // one of those with a name in gl::Key
    void type(char symbol); // ASCII
    void press(Key key);    // and keeps it down
    void release(Key key);

    // Buttons are X's: 1 left, 2 middle, 3 right. Places are pixels of the screen.
    void moveTo(int x, int y);
    void pressButton(int button);
    void releaseButton(int button);
    void click(int x, int y, int button = 1);
    void turnWheel(int notches); // away from the hand; below 0, towards it

  private:
    struct Close {
        void operator()(_XDisplay* display) const;
    };
    void tapSymbol(unsigned long symbol);
    void holdSymbol(unsigned long symbol, bool down);
    void holdButton(int button, bool down);

    std::unique_ptr<_XDisplay, Close> display_;
};

} // namespace obscura::gl
