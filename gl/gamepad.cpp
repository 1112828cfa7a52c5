#include "gl/gamepad.h"

#include <GLFW/glfw3.h>

#include <algorithm>

namespace obscura::gl {

static_assert(padButtons == GLFW_GAMEPAD_BUTTON_LAST + 1);
static_assert(mostPads == GLFW_JOYSTICK_LAST + 1);

namespace {

std::optional<Key> keyOf(int button) {
    switch (button) {
    case GLFW_GAMEPAD_BUTTON_A:
        return Key::padA;
    case GLFW_GAMEPAD_BUTTON_B:
        return Key::padB;
    case GLFW_GAMEPAD_BUTTON_X:
        return Key::padX;
    case GLFW_GAMEPAD_BUTTON_Y:
        return Key::padY;
    case GLFW_GAMEPAD_BUTTON_LEFT_BUMPER:
        return Key::padLeft;
    case GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER:
        return Key::padRight;
    case GLFW_GAMEPAD_BUTTON_BACK:
        return Key::escape;
    case GLFW_GAMEPAD_BUTTON_START:
        return Key::enter;
    case GLFW_GAMEPAD_BUTTON_DPAD_LEFT:
        return Key::left;
    case GLFW_GAMEPAD_BUTTON_DPAD_RIGHT:
        return Key::right;
    case GLFW_GAMEPAD_BUTTON_DPAD_UP:
        return Key::up;
    case GLFW_GAMEPAD_BUTTON_DPAD_DOWN:
        return Key::down;
    default: // the guide button, which systems take for themselves, and the sticks' own
        return std::nullopt;
    }
}

} // namespace

std::optional<PadState> padState(int pad) {
    GLFWgamepadstate state;
    if (!glfwGetGamepadState(pad, &state))
        return std::nullopt;
    PadState buttons{};
    std::copy(std::begin(state.buttons), std::end(state.buttons), buttons.begin());
    return buttons;
}

void Gamepads::look(double time, std::vector<Input>& inputs) {
    present_ = false;
    for (int pad = 0; pad < mostPads; ++pad) {
        const std::optional<PadState> now = source_(pad);
        present_ |= now.has_value();
        PadState& before = before_[static_cast<std::size_t>(pad)];
        const PadState after = now.value_or(PadState{});
        for (int button = 0; button < padButtons; ++button) {
            const auto at = static_cast<std::size_t>(button);
            const std::optional<Key> key = keyOf(button);
            if (!key || (before[at] != 0) == (after[at] != 0))
                continue;
            Input input;
            input.kind = after[at] ? Input::Kind::press : Input::Kind::release;
            input.time = time;
            input.key = *key;
            inputs.push_back(input);
        }
        before = after;
    }
}

} // namespace obscura::gl
