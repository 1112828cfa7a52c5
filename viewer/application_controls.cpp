// What keys do, and the hand on the camera.
#include "viewer/application.h"
#include "viewer/navigation.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

constexpr gl::Key letter(char c) { return static_cast<gl::Key>(c); }

void stepTechnique(State& state, int step) {
    const auto all = techniques();
    const int count = static_cast<int>(all.size());
    const auto selected = static_cast<std::size_t>(state.selected);
    const int now = static_cast<int>(&state.panes[selected].technique() - all.data());
    setTechnique(state, state.selected,
                 all[static_cast<std::size_t>((now + step + count) % count)]);
}

void flip(State& state) {
    state.flipped = !state.flipped;
    state.layout = Layout::flicker;
}

} // namespace

void Application::takeKeys() {
    flown_.clear();
    const std::vector<KeyPress> presses = window_.takePresses();
    pressed_ = !presses.empty();
    for (const KeyPress& key : presses)
        if (key.key == gl::Key::escape)
            escape();
        else if (ImGui::GetIO().WantTextInput || browser_.open)
            continue;
        else if (key.control)
            pressControl(key);
        else
            press(key);
}

void Application::escape() {
    const bool list = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    if (state_.help)
        state_.help = false;
    else if (list && !browser_.open)
        ImGui::ClosePopupsOverWindow(nullptr, false);
    else if (browser_.open)
        browser_.open = false;
    else if (window_.cursorLocked())
        window_.lockCursor(false);
    else if (status_.loading && opened_)
        worker_->abortOpening();
    else
        message_.text.clear();
}

void Application::pressControl(const KeyPress& key) {
    if (key.key == letter('O'))
        requests_.browse = true;
    else if (key.key == letter('Q'))
        window_.close();
}

void Application::press(const KeyPress& key) {
    const int number = static_cast<int>(key.key) - static_cast<int>(gl::Key::zero);
    if (number >= 1 && number <= 6)
        state_.layout = static_cast<Layout>(number - 1);
    else if (key.key == gl::Key::zero)
        state_.magnification = {};
    else if (key.key == gl::Key::space)
        flip(state_);
    else if (key.key == gl::Key::tab)
        state_.panels = !state_.panels;
    else if (key.key == gl::Key::f1 || key.key == letter('H'))
        state_.help = !state_.help;
    else if (key.key == gl::Key::f12)
        requests_.screenshot = true;
    else if (key.key == gl::Key::leftBracket || key.key == gl::Key::rightBracket)
        stepTechnique(state_, key.key == gl::Key::leftBracket ? -1 : 1);
    else if (key.key == letter('C'))
        cycleViews(state_, key.shift ? -1 : 1);
    else if (key.key == letter('P'))
        requests_.storeView = true;
    else if (key.key == letter('F'))
        requests_.frame = true;
    else if (key.key == letter('L'))
        window_.lockCursor(!window_.cursorLocked());
    else if (key.key == letter('O'))
        state_.show = static_cast<Show>((static_cast<int>(state_.show) + 1) %
                                        static_cast<int>(showNames().size()));
    else if (key.key == letter('T'))
        state_.textures = !state_.textures;
    else if (key.key == letter('X'))
        std::swap(state_.panes[0], state_.panes[1]);
    else
        flown_ += static_cast<char>(static_cast<int>(key.key) & 0x7F);
}

// A key that is held flies; one that was only touched, for a frame's worth. Gives whether the
// camera goes on moving by itself.
bool Application::fly() {
    const double now = window_.now(), since = now - lastFly_;
    lastFly_ = now;
    const std::array<double, 2> motion = window_.takeMotion();
    Camera& camera = state_.view.camera;
    if (window_.cursorLocked()) {
        const double notches = static_cast<double>(ImGui::GetIO().MouseWheel);
        if (notches != 0)
            state_.speed = nextSpeed(state_.speed, notches);
        if (motion[0] != 0 || motion[1] != 0)
            camera = looked(camera, motion[0] * 0.003, -motion[1] * 0.003);
    }
    if (ImGui::GetIO().WantTextInput || browser_.open || window_.controlIsDown())
        return false;
    const auto held = [&](char key) { return window_.isDown(letter(key)); };
    const auto along = [&](char forward, char back) {
        const auto pressed = [&](char key) {
            return held(key) || flown_.find(key) != std::string::npos ? 1 : 0;
        };
        return static_cast<double>(pressed(forward) - pressed(back));
    };
    const double right = along('D', 'A'), up = along('E', 'Q'), forward = along('W', 'S');
    if (right == 0 && up == 0 && forward == 0)
        return false;
    constexpr double touch = 1.0 / 60, longest = 0.1, hurry = 4;
    const double metres =
        state_.speed * std::clamp(since, touch, longest) * (window_.shiftIsDown() ? hurry : 1);
    camera = flown(camera, right * metres, up * metres, forward * metres);
    return held('W') || held('A') || held('S') || held('D') || held('Q') || held('E');
}

} // namespace obscura
