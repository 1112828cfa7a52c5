#pragma once

#include "gl/input.h"

#include <memory>

struct _XDisplay; // NOLINT(bugprone-reserved-identifier): so Xlib calls it

namespace obscura::gl {

// Presses keys as a hand on the keyboard would (the extension XTEST of the X server): they go to
// whichever window has the keyboard, and nothing tells them from others. An Error where there is
// no X server that can.
class Fingers {
  public:
    Fingers();

    void tap(Key key);      // one of those with a name in gl::Key
    void type(char symbol); // ASCII

  private:
    struct Close {
        void operator()(_XDisplay* display) const;
    };
    void tapSymbol(unsigned long symbol);

    std::unique_ptr<_XDisplay, Close> display_;
};

} // namespace obscura::gl
