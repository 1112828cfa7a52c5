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
    escape = 256,
    enter = 257,
    tab = 258,
    backspace = 259,
    right = 262,
    left = 263,
    down = 264,
    up = 265,
    keypadZero = 320,
    keypadOne = 321,
    keypadTwo = 322,
    keypadNine = 329,
    keypadEnter = 335,
};

// What a window was told, stamped when it arrived (seconds on the window's clock).
struct Input {
    enum class Kind { press, release, text, click, focusLost, focusGained, exposed, close };

    Kind kind = Kind::press;
    double time = 0;
    Key key{};                // press, release; the system's auto-repeat never arrives
    std::uint32_t symbol = 0; // text: a Unicode code point
    int x = 0, y = 0;         // click: framebuffer pixels from the top left
};

} // namespace obscura::gl
