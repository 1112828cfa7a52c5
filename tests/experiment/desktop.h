#pragma once

#include "image/image.h"

#include <sys/types.h>

#include <memory>
#include <string>

namespace obscura::test {

// A virtual screen of its own (Xvfb), with fingers (XTest) and eyes. Dies with this object.
class Desktop {
  public:
    Desktop(int width, int height, int bitsPerPixel = 24);
    ~Desktop();
    Desktop(const Desktop&) = delete;
    Desktop& operator=(const Desktop&) = delete;

    const std::string& name() const { return name_; } // ":7", for DISPLAY

    void press(unsigned long keySymbol);
    void release(unsigned long keySymbol);
    void tap(unsigned long keySymbol);
    void type(const std::string& lettersAndDigits);
    void click(int x, int y);

    // Gives the keyboard to no window, as when another program comes to the front, and back.
    void takeFocus();
    void returnFocus();

    // What a desktop's settings do when they scale everything to that many percent.
    void scaleTo(int percent);
    // From now on there is one who composes windows, as far as windows can tell.
    void startCompositor();

    // Pulls the plug of its only monitor.
    void unplug();

    Image8 look() const; // the whole screen, RGB
    // Of the presenter's window; "" when there is none. It changes once the presenter knows that
    // what it names is on the screen, and keys count.
    std::string title() const;
    bool hasKeyboard() const; // any window

  private:
    struct Connection;
    void start(int bitsPerPixel);

    int width_, height_;
    pid_t server_ = 0;
    std::string name_;
    std::unique_ptr<Connection> connection_;
    unsigned long focused_ = 0; // the window that takeFocus() took it from
};

} // namespace obscura::test
