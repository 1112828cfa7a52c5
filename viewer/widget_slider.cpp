// A slider that is read, dragged and typed into.
#include "viewer/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace obscura {

namespace {

// What is being typed into, and what was typed so far.
struct Typing {
    ImGuiID id = 0;
    bool begun = false;
    std::array<char, 32> text{};
};
Typing& typing() {
    static Typing state; // as ImGui's own state: one keyboard, one thread
    return state;
}

void beginTyping(ImGuiID id, double value) {
    Typing& state = typing();
    state = {id, false, {}};
    fmt::format_to_n(state.text.begin(), state.text.size() - 1, "{:.6g}", value);
}

// Whether it ended with a number.
bool type(Ui& ui, const SliderRow& row, double& value, float width) {
    Typing& state = typing();
    ImGui::SetNextItemWidth(width);
    if (!state.begun)
        ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputText("##typed", state.text.data(), state.text.size(),
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
                             ImGuiInputTextFlags_CharsScientific);
    ui.wake(0.3); // the caret blinks
    const bool left = state.begun && !ImGui::IsItemActive();
    state.begun = state.begun || ImGui::IsItemActive();
    if (!entered && !left)
        return false;
    state.id = 0;
    char* end = nullptr;
    const double typed = std::strtod(state.text.data(), &end);
    if (end == state.text.data() || !std::isfinite(typed))
        return false;
    value = std::clamp(row.scale.whole ? std::round(typed) : typed, row.scale.low, row.scale.high);
    return true;
}

void drawTrack(Ui& ui, const SliderRow& row, double value, const ImVec2& low, const ImVec2& high,
               bool hot) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float y = std::floor((low.y + high.y) / 2), thick = ui.px(4), radius = ui.px(hot ? 6 : 5);
    const float left = low.x + ui.px(6), right = high.x - ui.px(6);
    const auto at = [&](double v) {
        return left + (right - left) * static_cast<float>(positionOf(row.scale, v));
    };
    list.AddRectFilled({left, y - thick / 2}, {right, y + thick / 2}, colours::fieldHeld,
                       thick / 2);
    list.AddRectFilled({left, y - thick / 2}, {at(value), y + thick / 2},
                       hot ? colours::accent : colours::accentDim, thick / 2);
    const float mark = at(row.standard);
    list.AddLine({mark, y + ui.px(5)}, {mark, y + ui.px(8)}, colours::faint, ui.px(1));
    list.AddCircleFilled({at(value), y}, radius, hot ? colours::text : colours::muted, 24);
}

bool dragTrack(Ui& ui, const SliderRow& row, double& value, float width) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 high{low.x + width, low.y + ui.px(rowHeight)};
    ImGui::InvisibleButton("##track", {width, ui.px(rowHeight)});
    const bool held = ImGui::IsItemActive();
    const double before = value;
    if (held) {
        const ImGuiIO& io = ImGui::GetIO();
        const float left = low.x + ui.px(6), length = width - ui.px(12);
        if (io.KeyShift && !ImGui::IsItemActivated()) {
            if (io.MouseDelta.x != 0)
                value = valueAt(row.scale, positionOf(row.scale, value) +
                                               0.1 * static_cast<double>(io.MouseDelta.x / length));
        } else if (io.MouseDelta.x != 0 || ImGui::IsItemActivated())
            value = valueAt(row.scale, static_cast<double>((io.MousePos.x - left) / length));
    }
    ui.note(row.label);
    drawTrack(ui, row, value, low, high, held || ImGui::IsItemHovered());
    tooltip(ui, held ? "" : row.tip);
    return value != before;
}

bool showValue(Ui& ui, const SliderRow& row, double& value) {
    const ImGuiID id = ImGui::GetID("##value");
    const float width = ui.px(rowValueWidth);
    if (typing().id == id)
        return type(ui, row, value, width);
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 high{low.x + width, low.y + ui.px(rowHeight)};
    ImGui::InvisibleButton("##value", {width, ui.px(rowHeight)});
    ui.note((std::string(row.label) + " value").c_str());
    const bool hovered = ImGui::IsItemHovered();
    if (hovered &&
        (ImGui::IsMouseDoubleClicked(0) || (ImGui::GetIO().KeyCtrl && ImGui::IsMouseClicked(0))))
        beginTyping(id, value);
    tooltip(ui, "Double-click to type a number");
    const std::string text = valueText(value, row.unit);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    ImGui::GetWindowDrawList()->AddText(
        {high.x - size.x, std::floor((low.y + high.y - size.y) / 2)},
        hovered ? colours::accent : colours::text, text.c_str());
    return false;
}

bool resetSign(Ui& ui, const SliderRow& row, double& value) {
    const float tolerance = 1e-6F * static_cast<float>(std::abs(row.standard) + 1e-6);
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size{ui.px(rowResetWidth), ui.px(rowHeight)};
    if (std::abs(static_cast<float>(value - row.standard)) <= tolerance) {
        ImGui::Dummy(size);
        return false;
    }
    const bool pressed = ImGui::InvisibleButton("##reset", size);
    ui.note((std::string(row.label) + " reset").c_str());
    tooltip(ui, "Back to " + valueText(row.standard, row.unit));
    ImGui::GetWindowDrawList()->AddText(centredText(low, {low.x + size.x, low.y + size.y}, "↺"),
                                        ImGui::IsItemHovered() ? colours::text : colours::faint,
                                        "↺");
    if (pressed)
        value = row.standard;
    return pressed;
}

} // namespace

bool slider(Ui& ui, const SliderRow& row, double& value) {
    ImGui::PushID(row.label);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ui.px(1)});
    rowLabel(ui, shown(row.label), colours::muted);
    const float full = ImGui::GetContentRegionAvail().x;
    const float track = full - ui.px(rowLabelWidth + rowValueWidth);
    ImGui::InvisibleButton("##name", {ui.px(rowLabelWidth - rowResetWidth), ui.px(rowHeight)});
    tooltip(ui, row.tip);
    ImGui::SameLine();
    bool changed = resetSign(ui, row, value);
    ImGui::SameLine();
    changed |= dragTrack(ui, row, value, track);
    ImGui::SameLine();
    changed |= showValue(ui, row, value);
    ImGui::PopStyleVar();
    ImGui::PopID();
    return changed;
}

} // namespace obscura
