#pragma once

#include "gl/input.h"

#include <array>
#include <optional>
#include <vector>

namespace obscura::gl {

// Gamepads have no events: their buttons are looked at again and again, and what has changed since
// becomes presses and releases of keys (gl/input.h).

constexpr int padButtons = 15, mostPads = 16;           // as GLFW counts them
using PadState = std::array<unsigned char, padButtons>; // 1 where a button is down

// How the nth gamepad, from 0, is at the moment; nothing where there is none. GLFW's word, or a
// test's.
using PadSource = std::optional<PadState> (*)(int pad);
std::optional<PadState> padState(int pad); // GLFW's, of pads whose layout it knows

class Gamepads {
  public:
    explicit Gamepads(PadSource source = padState) : source_(source) {}

    // Adds what has changed since the last look. A pad that is pulled out lets go of all.
    void look(double time, std::vector<Input>& inputs);
    bool present() const { return present_; } // at the last look, any

  private:
    PadSource source_;
    std::array<PadState, mostPads> before_{};
    bool present_ = false;
};

} // namespace obscura::gl
