#include "viewer/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace obscura {

namespace {

// Of rows, logical pixels. The sign that resets stands at the end of the label.
constexpr double labelWidth = 152, resetWidth = 18, valueWidth = 58, rowHeight = 24;

ImVec2 centredText(const ImVec2& low, const ImVec2& high, const char* text) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    return {std::floor((low.x + high.x - size.x) / 2), std::floor((low.y + high.y - size.y) / 2)};
}

void rowLabel(Ui& ui, const std::string& name, ImU32 colour) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float y = at.y + std::floor((ui.px(rowHeight) - ImGui::GetTextLineHeight()) / 2);
    ImGui::GetWindowDrawList()->AddText({at.x, y}, colour,
                                        fitted(name, ui.px(labelWidth - resetWidth)).c_str());
}

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
    const float width = ui.px(valueWidth);
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
    const ImVec2 size{ui.px(resetWidth), ui.px(rowHeight)};
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

void Ui::note(const char* label) {
    const ImVec2 low = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
    places[label] = {static_cast<double>(low.x), static_cast<double>(low.y),
                     static_cast<double>(size.x), static_cast<double>(size.y)};
}

void Ui::wake(double seconds) { wakeIn = std::min(wakeIn, seconds); }

std::string shown(const char* label) {
    const std::string text = label;
    return text.substr(0, text.find("##"));
}

std::string fitted(const std::string& text, float width, bool keepEnd) {
    if (ImGui::CalcTextSize(text.c_str()).x <= width)
        return text;
    std::string cut = text;
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
    while (!cut.empty() && ImGui::CalcTextSize((cut + "…").c_str()).x > width) {
        if (keepEnd) {
            cut.erase(0, 1);
            while (!cut.empty() && continues(cut.front()))
                cut.erase(0, 1);
        } else {
            while (cut.size() > 1 && continues(cut.back()))
                cut.pop_back();
            cut.pop_back();
        }
    }
    return keepEnd ? "…" + cut : cut + "…";
}

void heading(Ui& ui, const char* text) {
    ImGui::Dummy({0, ui.px(4)});
    ImGui::PushFont(ui.theme.bold);
    ImGui::PushStyleColor(ImGuiCol_Text, colours::text);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void remark(Ui& ui, const std::string& text, ImU32 colour) {
    ImGui::PushFont(ui.theme.small);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void fact(Ui& ui, const char* name, const std::string& value, const std::string& tip) {
    const float full = ImGui::GetContentRegionAvail().x, height = ui.px(20);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float y = at.y + std::floor((height - ImGui::GetTextLineHeight()) / 2);
    const float nameWidth = ImGui::CalcTextSize(name).x;
    const std::string text = fitted(value, full - nameWidth - ui.px(10), true);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText({at.x, y}, colours::muted, name);
    list.AddText({at.x + full - ImGui::CalcTextSize(text.c_str()).x, y}, colours::text,
                 text.c_str());
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ui.px(1)});
    ImGui::Dummy({full, height});
    ImGui::PopStyleVar();
    ui.note(name);
    tooltip(ui, tip.empty() && text != value ? value : tip);
}

void tooltip(Ui& ui, const std::string& text) {
    constexpr float delay = 0.45F;
    if (text.empty() || !ImGui::IsItemHovered())
        return;
    const bool counted =
        GImGui->LastItemData.ID != 0 && GImGui->HoveredId == GImGui->LastItemData.ID;
    const float hovered = counted ? GImGui->HoveredIdTimer : delay;
    if (hovered < delay) {
        ui.wake(static_cast<double>(delay - hovered) + 0.01);
        return;
    }
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(10), ui.px(8)});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ui.px(340));
    const std::size_t first = text.find('\n');
    ImGui::TextUnformatted(text.substr(0, first).c_str());
    if (first != std::string::npos) {
        ImGui::PushFont(ui.theme.small);
        ImGui::PushStyleColor(ImGuiCol_Text, colours::muted);
        ImGui::TextUnformatted(text.substr(first + 1).c_str());
        ImGui::PopStyleColor();
        ImGui::PopFont();
    }
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

bool slider(Ui& ui, const SliderRow& row, double& value) {
    ImGui::PushID(row.label);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ui.px(1)});
    rowLabel(ui, shown(row.label), colours::muted);
    const float full = ImGui::GetContentRegionAvail().x;
    const float track = full - ui.px(labelWidth + valueWidth);
    ImGui::InvisibleButton("##name", {ui.px(labelWidth - resetWidth), ui.px(rowHeight)});
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

bool toggle(Ui& ui, const char* label, bool& on, const std::string& tip) {
    const float full = ImGui::GetContentRegionAvail().x;
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const std::string name = shown(label);
    const float y = low.y + std::floor((ui.px(rowHeight) - ImGui::GetTextLineHeight()) / 2);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ui.px(1)});
    const bool pressed = ImGui::InvisibleButton(label, {full, ui.px(rowHeight)});
    ImGui::PopStyleVar();
    if (pressed)
        on = !on;
    ui.note(label);
    const bool hovered = ImGui::IsItemHovered();
    tooltip(ui, tip);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText({low.x, y}, hovered ? colours::text : colours::muted, name.c_str());
    const float width = ui.px(30), height = ui.px(16), right = low.x + full;
    const float top = low.y + std::floor((ui.px(rowHeight) - height) / 2);
    list.AddRectFilled({right - width, top}, {right, top + height},
                       on ? colours::accent : (hovered ? colours::fieldHeld : colours::field),
                       height / 2);
    list.AddCircleFilled({on ? right - height / 2 : right - width + height / 2, top + height / 2},
                         height / 2 - ui.px(2.5), on ? IM_COL32_WHITE : colours::muted, 24);
    return pressed;
}

bool segments(Ui& ui, const char* label, std::span<const std::string> words, int& chosen,
              const std::string& tip) {
    const std::string name = shown(label);
    bool changed = false;
    ImGui::PushID(label);
    if (!name.empty()) {
        rowLabel(ui, name, colours::muted);
        ImGui::InvisibleButton("##name", {ui.px(labelWidth - resetWidth), ui.px(rowHeight)});
        tooltip(ui, tip);
        ImGui::SameLine(0, 0);
    }
    const float full = ImGui::GetContentRegionAvail().x, height = ui.px(rowHeight);
    const ImVec2 low = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, {low.x + full, low.y + height}, colours::field, ui.px(5));
    float text = 0;
    for (const std::string& word : words)
        text += ImGui::CalcTextSize(word.c_str()).x;
    const float pad = (full - text) / static_cast<float>(words.size());
    for (int i = 0; i < static_cast<int>(words.size()); ++i) {
        const std::string& word = words[static_cast<std::size_t>(i)];
        if (i > 0)
            ImGui::SameLine(0, 0);
        const ImVec2 from = ImGui::GetCursorScreenPos();
        const float each = ImGui::CalcTextSize(word.c_str()).x + pad;
        const ImVec2 to{from.x + each, from.y + height};
        ImGui::PushID(i);
        if (ImGui::InvisibleButton("##segment", {each, height}) && chosen != i) {
            chosen = i;
            changed = true;
        }
        ui.note(word.c_str());
        const bool hovered = ImGui::IsItemHovered();
        if (i == chosen || hovered)
            list.AddRectFilled({from.x + ui.px(2), from.y + ui.px(2)},
                               {to.x - ui.px(2), to.y - ui.px(2)},
                               i == chosen ? colours::accentDim : colours::fieldHovered, ui.px(4));
        list.AddText(centredText(from, to, word.c_str()),
                     i == chosen ? colours::text : colours::muted, word.c_str());
        ImGui::PopID();
    }
    ImGui::PopID();
    return changed;
}

bool choice(Ui& ui, const char* label, std::span<const std::string> words, int& chosen,
            std::span<const std::string> tips) {
    const std::string name = shown(label);
    bool changed = false;
    ImGui::PushID(label);
    if (!name.empty()) {
        rowLabel(ui, name, colours::muted);
        ImGui::Dummy({ui.px(labelWidth - resetWidth), ui.px(rowHeight)});
        ImGui::SameLine(0, 0);
    }
    const float full = ImGui::GetContentRegionAvail().x, height = ui.px(rowHeight + 1);
    const ImVec2 low = ImGui::GetCursorScreenPos(), high{low.x + full, low.y + height};
    if (ImGui::InvisibleButton("##open", {full, height}))
        ImGui::OpenPopup("##list");
    ui.note(label);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, high, ImGui::IsItemHovered() ? colours::fieldHovered : colours::field,
                       ui.px(5));
    const std::string now = chosen >= 0 && chosen < static_cast<int>(words.size())
                                ? words[static_cast<std::size_t>(chosen)]
                                : std::string("–");
    const float y = low.y + std::floor((height - ImGui::GetTextLineHeight()) / 2);
    list.AddText({low.x + ui.px(9), y}, colours::text, fitted(now, full - ui.px(34)).c_str());
    list.AddText({high.x - ui.px(18), y}, colours::faint, "▾");
    ImGui::SetNextWindowPos({low.x, high.y + ui.px(3)});
    ImGui::SetNextWindowSizeConstraints({full, 0}, {ui.px(520), ui.px(540)});
    if (ImGui::BeginPopup("##list")) {
        for (int i = 0; i < static_cast<int>(words.size()); ++i) {
            const std::string& word = words[static_cast<std::size_t>(i)];
            ImGui::PushID(i);
            if (ImGui::Selectable(word.c_str(), i == chosen)) {
                changed = chosen != i;
                chosen = i;
            }
            ui.note(word.c_str());
            if (i < static_cast<int>(tips.size()))
                tooltip(ui, tips[static_cast<std::size_t>(i)]);
            if (i == chosen && ImGui::IsWindowAppearing())
                ImGui::SetScrollHereY();
            ImGui::PopID();
        }
        ImGui::EndPopup();
    }
    ImGui::PopID();
    return changed;
}

bool button(Ui& ui, const char* label, const std::string& tip, float width, ButtonKind kind,
            bool on) {
    const std::string name = shown(label);
    const ImVec2 text = ImGui::CalcTextSize(name.c_str());
    const float own = text.x + ui.px(22);
    const ImVec2 size{width < 0   ? ImGui::GetContentRegionAvail().x
                      : width > 0 ? width
                                  : own,
                      ui.px(rowHeight + 2)};
    const ImVec2 low = ImGui::GetCursorScreenPos(), high{low.x + size.x, low.y + size.y};
    const bool pressed = ImGui::InvisibleButton(label, size);
    ui.note(label);
    const bool hovered = ImGui::IsItemHovered();
    tooltip(ui, tip);
    ImU32 fill = hovered ? colours::fieldHovered : colours::field;
    if (kind == ButtonKind::quiet && !hovered)
        fill = IM_COL32(0, 0, 0, 0);
    if (kind == ButtonKind::primary || on)
        fill = hovered ? colours::accent : colours::accentDim;
    if (ImGui::IsItemActive())
        fill = colours::fieldHeld;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool dim = (GImGui->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0;
    list.AddRectFilled(low, high, dim ? faded(fill, 0.5F) : fill, ui.px(5));
    list.AddText(centredText(low, high, name.c_str()), dim ? colours::faint : colours::text,
                 name.c_str());
    return pressed;
}

void progressBar(Ui& ui, double share, float width, float height) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, {low.x + width, low.y + height}, colours::fieldHeld, height / 2);
    const float filled = width * static_cast<float>(std::clamp(share, 0.0, 1.0));
    if (filled > height / 2)
        list.AddRectFilled(low, {low.x + filled, low.y + height}, colours::accent, height / 2);
    ImGui::Dummy({width, height});
    (void)ui;
}

} // namespace obscura
