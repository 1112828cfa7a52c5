#include "viewer/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace obscura {

ImVec2 centredText(const ImVec2& low, const ImVec2& high, const char* text) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    return {std::floor((low.x + high.x - size.x) / 2), std::floor((low.y + high.y - size.y) / 2)};
}

void rowLabel(Ui& ui, const std::string& name, ImU32 colour) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float y = at.y + std::floor((ui.px(rowHeight) - ImGui::GetTextLineHeight()) / 2);
    ImGui::GetWindowDrawList()->AddText({at.x, y}, colour,
                                        fitted(name, ui.px(rowLabelWidth - rowResetWidth)).c_str());
}

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
        ImGui::InvisibleButton("##name", {ui.px(rowLabelWidth - rowResetWidth), ui.px(rowHeight)});
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
        ImGui::Dummy({ui.px(rowLabelWidth - rowResetWidth), ui.px(rowHeight)});
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
