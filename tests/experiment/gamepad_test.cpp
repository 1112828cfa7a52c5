#include "gl/gamepad.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <map>

namespace obscura::gl {
namespace {

// No gamepad can be made here (/dev/uinput), so these stand in for what GLFW says of one.
std::map<int, PadState> pads;

std::optional<PadState> scripted(int pad) {
    const auto found = pads.find(pad);
    return found == pads.end() ? std::nullopt : std::optional(found->second);
}

class GamepadTest : public testing::Test {
  protected:
    Gamepads gamepads{scripted};

    void SetUp() override { pads.clear(); }
    std::vector<Input> look(double time = 1) {
        std::vector<Input> inputs;
        gamepads.look(time, inputs);
        return inputs;
    }
};

TEST_F(GamepadTest, WithoutOneThereIsNothing) {
    EXPECT_TRUE(look().empty());
    EXPECT_FALSE(gamepads.present());
}

TEST_F(GamepadTest, AButtonIsAKeyThatIsPressedOnceAndLetGo) {
    pads[3] = {};
    EXPECT_TRUE(look().empty());
    EXPECT_TRUE(gamepads.present());
    pads[3][GLFW_GAMEPAD_BUTTON_A] = 1;
    const std::vector<Input> pressed = look(2.5);
    ASSERT_EQ(pressed.size(), 1u);
    EXPECT_EQ(pressed[0].kind, Input::Kind::press);
    EXPECT_EQ(pressed[0].key, Key::padA);
    EXPECT_EQ(pressed[0].time, 2.5);
    EXPECT_TRUE(look().empty()) << "held down";
    pads[3][GLFW_GAMEPAD_BUTTON_A] = 0;
    const std::vector<Input> released = look();
    ASSERT_EQ(released.size(), 1u);
    EXPECT_EQ(released[0].kind, Input::Kind::release);
}

TEST_F(GamepadTest, ItsButtonsAreTheKeysThatPagesKnow) {
    const std::map<int, Key> expected = {{GLFW_GAMEPAD_BUTTON_BACK, Key::escape},
                                         {GLFW_GAMEPAD_BUTTON_START, Key::enter},
                                         {GLFW_GAMEPAD_BUTTON_DPAD_LEFT, Key::left},
                                         {GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, Key::right},
                                         {GLFW_GAMEPAD_BUTTON_DPAD_UP, Key::up},
                                         {GLFW_GAMEPAD_BUTTON_DPAD_DOWN, Key::down},
                                         {GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, Key::padLeft},
                                         {GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, Key::padRight}};
    for (const auto& [button, key] : expected) {
        pads[0] = {};
        look();
        pads[0][static_cast<std::size_t>(button)] = 1;
        const std::vector<Input> inputs = look();
        ASSERT_EQ(inputs.size(), 1u) << button;
        EXPECT_EQ(inputs[0].key, key) << button;
    }
}

TEST_F(GamepadTest, OneThatIsPulledOutLetsGo) {
    pads[0] = {};
    pads[0][GLFW_GAMEPAD_BUTTON_B] = 1;
    look();
    pads.clear();
    const std::vector<Input> inputs = look();
    ASSERT_EQ(inputs.size(), 1u);
    EXPECT_EQ(inputs[0].kind, Input::Kind::release);
    EXPECT_FALSE(gamepads.present());
}

} // namespace
} // namespace obscura::gl
