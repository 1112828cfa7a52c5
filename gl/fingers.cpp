#include "gl/fingers.h"

#include "base/error.h"

#include <X11/XKBlib.h>
#include <X11/Xlib.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace obscura::gl {

namespace {

unsigned long symbolOf(Key key) {
    switch (key) {
    case Key::enter:
        return XK_Return;
    case Key::escape:
        return XK_Escape;
    case Key::tab:
        return XK_Tab;
    case Key::backspace:
        return XK_BackSpace;
    case Key::right:
        return XK_Right;
    case Key::left:
        return XK_Left;
    case Key::down:
        return XK_Down;
    case Key::up:
        return XK_Up;
    case Key::leftShift:
        return XK_Shift_L;
    case Key::leftControl:
        return XK_Control_L;
    default:
        if (key >= Key::f1 && key <= Key::f12)
            return XK_F1 + static_cast<unsigned long>(key) - static_cast<unsigned long>(Key::f1);
        if (key >= Key::keypadZero && key <= Key::keypadNine)
            return XK_KP_0 + static_cast<unsigned long>(key) -
                   static_cast<unsigned long>(Key::keypadZero);
        if (key >= Key::a && key <= Key::z) // the letter without shift
            return static_cast<unsigned long>(key) - 'A' + 'a';
        return static_cast<unsigned long>(key); // ASCII, as X has it
    }
}

} // namespace

void Fingers::Close::operator()(_XDisplay* display) const { XCloseDisplay(display); }

Fingers::Fingers() : display_(XOpenDisplay(nullptr)) {
    int ignored = 0;
    if (!display_ || !XTestQueryExtension(display_.get(), &ignored, &ignored, &ignored, &ignored))
        throw Error(
            "expected an X server with the extension XTEST, which presses keys, found none; "
            "start it as Xvfb :7 -screen 0 1280x800x24, and set DISPLAY=:7");
}

void Fingers::tap(Key key) { tapSymbol(symbolOf(key)); }

void Fingers::type(char symbol) { tapSymbol(static_cast<unsigned char>(symbol)); }

void Fingers::press(Key key) { holdSymbol(symbolOf(key), true); }
void Fingers::release(Key key) { holdSymbol(symbolOf(key), false); }

void Fingers::holdSymbol(unsigned long symbol, bool down) {
    XTestFakeKeyEvent(display_.get(), XKeysymToKeycode(display_.get(), symbol), down, CurrentTime);
    XSync(display_.get(), False);
}

void Fingers::moveTo(int x, int y) {
    XTestFakeMotionEvent(display_.get(), -1, x, y, CurrentTime);
    XSync(display_.get(), False);
}

void Fingers::pressButton(int button) { holdButton(button, true); }
void Fingers::releaseButton(int button) { holdButton(button, false); }

void Fingers::holdButton(int button, bool down) {
    XTestFakeButtonEvent(display_.get(), static_cast<unsigned>(button), down, CurrentTime);
    XSync(display_.get(), False);
}

void Fingers::click(int x, int y, int button) {
    moveTo(x, y);
    pressButton(button);
    releaseButton(button);
}

// A wheel is two buttons to X.
void Fingers::turnWheel(int notches) {
    for (int i = 0; i < std::abs(notches); ++i) {
        pressButton(notches > 0 ? 4 : 5);
        releaseButton(notches > 0 ? 4 : 5);
    }
}

// The server stamps in milliseconds, and GLFW takes a second press of the same stamp for an echo.
void Fingers::tapSymbol(unsigned long symbol) {
    Display* display = display_.get();
    const KeyCode code = XKeysymToKeycode(display, symbol);
    if (code == 0)
        throw Error(fmt::format("the keyboard has no key for the symbol {:#x}; choose a layout "
                                "that has: setxkbmap us",
                                symbol));
    const bool shifted = XkbKeycodeToKeysym(display, code, 0, 0) != symbol &&
                         XkbKeycodeToKeysym(display, code, 0, 1) == symbol;
    const KeyCode shift = XKeysymToKeycode(display, XK_Shift_L);
    if (shifted)
        XTestFakeKeyEvent(display, shift, True, CurrentTime);
    XTestFakeKeyEvent(display, code, True, CurrentTime);
    XTestFakeKeyEvent(display, code, False, CurrentTime);
    if (shifted)
        XTestFakeKeyEvent(display, shift, False, CurrentTime);
    XSync(display, False);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

} // namespace obscura::gl
