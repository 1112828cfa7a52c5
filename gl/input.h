#pragma once

#include <cstdint>

namespace obscura::gl {

// A physical key. The values are GLFW's, so a key without a name here keeps its own number.
enum class Key : int {
    space = 32,
    zero = 48,
    one = 49, // and so on to nine
    two = 50,
    nine = 57,
    a = 65, // and so on to z
    z = 90,
    leftBracket = 91,
    rightBracket = 93,
    escape = 256,
    enter = 257,
    tab = 258,
    backspace = 259,
    right = 262,
    left = 263,
    down = 264,
    up = 265,
    f1 = 290, // and so on to f12
    f12 = 301,
    keypadZero = 320,
    keypadOne = 321,
    keypadTwo = 322,
    keypadNine = 329,
    keypadEnter = 335,
    leftShift = 340,
    leftControl = 341,
    // Buttons of a gamepad; GLFW has no numbers for them among keys. Its directional pad arrives as
    // the arrows, "back" as Escape and "start" as Enter.
    padA = 1000,
    padB = 1001,
    padX = 1002,
    padY = 1003,
    padLeft = 1004, // the buttons at the shoulders
    padRight = 1005,
};

// What a window was told, stamped when it arrived (seconds on the window's clock).
struct Input {
    enum class Kind { press, release, text, click, drag, focusLost, focusGained, exposed, close };

    Kind kind = Kind::press;
    double time = 0;
    Key key{};                // press, release; the system's auto-repeat never arrives
    std::uint32_t symbol = 0; // text: a Unicode code point
    int x = 0, y = 0;         // click, drag: framebuffer pixels from the top left
};

} // namespace obscura::gl
