// The column at the side, and its first tab: which technique each pane has, and every setting that
// the technique table declares.
#include "renderer/techniques/fetches.h"
#include "viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace obscura {

namespace {

bool drawTab(Ui& ui, const std::string& name, bool on, float width) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 high{low.x + width, low.y + ui.px(34)};
    const bool pressed = ImGui::InvisibleButton(name.c_str(), {width, ui.px(34)});
    ui.note(("tab " + name).c_str());
    const bool hovered = ImGui::IsItemHovered();
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(
        {std::floor((low.x + high.x - size.x) / 2), std::floor((low.y + high.y - size.y) / 2)},
        on || hovered ? colours::text : colours::muted, name.c_str());
    if (on)
        list.AddRectFilled({low.x + ui.px(8), high.y - ui.px(2)}, {high.x - ui.px(8), high.y},
                           colours::accent, ui.px(1));
    return pressed;
}

void tabs(Moment& moment) {
    Ui& ui = moment.ui;
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float full = ImGui::GetContentRegionAvail().x;
    const float each = full / static_cast<float>(tabTitles().size());
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    for (int i = 0; i < static_cast<int>(tabTitles().size()); ++i) {
        if (i > 0)
            ImGui::SameLine();
        if (drawTab(ui, tabTitles()[static_cast<std::size_t>(i)],
                    moment.state.tab == static_cast<Tab>(i), each))
            moment.state.tab = static_cast<Tab>(i);
    }
    ImGui::PopStyleVar();
    ImGui::GetWindowDrawList()->AddLine({low.x, low.y + ui.px(34)},
                                        {low.x + full, low.y + ui.px(34)}, colours::line);
}

// Which pane the settings below are of; where one is seen alone, which of all.
void paneButtons(Moment& moment) {
    Ui& ui = moment.ui;
    State& state = moment.state;
    const int count = state.layout == Layout::single ? static_cast<int>(state.panes.size())
                                                     : panesOf(state.layout);
    state.selected = std::min(state.selected, count - 1);
    const float gap = ui.px(6), width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    for (int pane = 0; pane < count; ++pane) { // in two columns, as in the grid
        if (pane % 2 == 1)
            ImGui::SameLine(0, gap);
        const auto index = static_cast<std::size_t>(pane);
        const ImVec2 low = ImGui::GetCursorScreenPos(), size{width, ui.px(30)};
        const ImVec2 high{low.x + size.x, low.y + size.y};
        if (ImGui::InvisibleButton(("pane " + letterOf(pane)).c_str(), size))
            state.selected = pane;
        ui.note(("pane " + letterOf(pane)).c_str());
        const bool on = pane == state.selected, hovered = ImGui::IsItemHovered();
        tooltip(ui, std::string(state.panes[index].technique().title));
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(low, high, on || hovered ? colours::fieldHovered : colours::field,
                           ui.px(5));
        if (on)
            list.AddRect(low, high, colours::panes[index], ui.px(5), 0, ui.px(1.5));
        const float y = low.y + std::floor((size.y - ImGui::GetTextLineHeight()) / 2);
        ImGui::PushFont(ui.theme.bold);
        list.AddText({low.x + ui.px(9), y}, colours::panes[index], letterOf(pane).c_str());
        ImGui::PopFont();
        const std::string id =
            fitted(std::string(state.panes[index].technique().id), width - ui.px(34));
        list.AddText({low.x + ui.px(26), y}, on ? colours::text : colours::muted, id.c_str());
    }
    ImGui::Dummy({0, ui.px(2)});
}

void chooseTechnique(Moment& moment) {
    static const std::vector<std::string> titles = [] {
        std::vector<std::string> all;
        for (const Technique& each : techniques())
            all.emplace_back(each.title);
        return all;
    }();
    static const std::vector<std::string> citations = [] {
        std::vector<std::string> all;
        for (const Technique& each : techniques())
            all.push_back(fmt::format("{}\n{}", each.id, each.citation));
        return all;
    }();
    State& state = moment.state;
    const Technique& now = state.panes[static_cast<std::size_t>(state.selected)].technique();
    int chosen = static_cast<int>(&now - techniques().data());
    if (choice(moment.ui, "##technique", titles, chosen, citations))
        setTechnique(state, state.selected, techniques()[static_cast<std::size_t>(chosen)]);
    remark(moment.ui, std::string(now.citation), colours::faint);
}

bool isPreset(const Settings& settings, const Preset& preset) {
    return std::all_of(preset.values.begin(), preset.values.end(), [&](const PresetValue& value) {
        return settings[value.name] == value.value;
    });
}

void presets(Moment& moment, Settings& settings) {
    const auto all = settings.technique().presets;
    if (all.empty())
        return;
    std::vector<std::string> names;
    int chosen = -1;
    for (const Preset& preset : all) {
        if (isPreset(settings, preset))
            chosen = static_cast<int>(names.size());
        names.emplace_back(preset.name);
    }
    constexpr std::size_t mostSideBySide = 4;
    if (names.size() > mostSideBySide
            ? choice(moment.ui, "Preset", names, chosen)
            : segments(moment.ui, "Preset", names, chosen,
                       "Settings that its authors offer together under one name"))
        settings.apply(names[static_cast<std::size_t>(chosen)]);
}

bool setting(Ui& ui, Settings& settings, const Parameter& parameter) {
    const std::string label = inWords(parameter.name) + "##" + std::string(parameter.name);
    double value = static_cast<double>(settings[parameter.name]);
    bool changed = false;
    if (parameter.unit == Unit::flag) {
        bool on = value > 0;
        changed = toggle(ui, label.c_str(), on, meaningOf(parameter));
        value = on ? 1 : 0;
    } else
        changed = slider(ui,
                         {label.c_str(), scaleOf(parameter), static_cast<double>(parameter.value),
                          parameter.unit, meaningOf(parameter)},
                         value);
    ui.places["setting " + std::string(parameter.name)] = ui.places[label];
    if (changed)
        settings.set(parameter.name, value);
    return changed;
}

bool isDefault(const Settings& settings) {
    for (const Parameter& parameter : settings.technique().parameters)
        if (parameter.name != "radius" && settings[parameter.name] != parameter.value)
            return false;
    return true;
}

// The radius is the scene's, the same for every technique.
void radiusRow(Moment& moment) {
    State& state = moment.state;
    double radius = state.view.radius;
    const double standard = moment.opened ? moment.opened->radius : radius;
    if (slider(moment.ui,
               {"Radius of all##radius",
                scaleBetween(std::max(state.size / 1000, 1e-4),
                             std::min(std::max(state.size, 0.2), 1e4)),
                standard, Unit::metre,
                "How far occluders are looked for, the same for every technique\nOne radius per "
                "scene is what a study compares techniques at"},
               radius))
        setRadius(state, radius);
    moment.ui.places["setting radius"] = moment.ui.places["Radius of all##radius"];
}

void buttonsBelow(Moment& moment, Settings& settings) {
    Ui& ui = moment.ui;
    State& state = moment.state;
    const float gap = ui.px(6);
    const float half = (ImGui::GetContentRegionAvail().x - gap) / 2;
    ImGui::BeginDisabled(isDefault(settings));
    if (button(ui, "Reset all", "All settings of this technique back to their defaults", half))
        setTechnique(state, state.selected, settings.technique());
    ImGui::EndDisabled();
    ImGui::SameLine(0, gap);
    ImGui::BeginDisabled(panesOf(state.layout) < 2);
    if (button(ui, "Swap A and B", "A and B change places  (X)", half))
        std::swap(state.panes[0], state.panes[1]);
    ImGui::EndDisabled();
    if (panesOf(state.layout) > 1 &&
        toggle(ui, "Same samples as A", state.sameSamples,
               "All panes make about as many texture fetches a pixel as A does\nBy the counts that "
               "each has: samples, or directions and steps"))
        matchSamples(state);
    const double fetches = fetchesPerPixel(settings);
    if (fetches > 0)
        fact(ui, "Texture fetches a pixel", fmt::format("{:.4g}", fetches),
             "As its passes declare them, at most");
}

} // namespace

void techniquesTab(Moment& moment) {
    State& state = moment.state;
    paneButtons(moment);
    chooseTechnique(moment);
    Settings& settings = state.panes[static_cast<std::size_t>(state.selected)];
    presets(moment, settings);
    bool changed = false;
    ImGui::PushID(static_cast<int>(&settings.technique() - techniques().data()));
    for (const Parameter& parameter : settings.technique().parameters)
        if (parameter.name != "radius")
            changed |= setting(moment.ui, settings, parameter);
    ImGui::PopID();
    radiusRow(moment);
    ImGui::Dummy({0, moment.ui.px(2)});
    if (changed)
        matchSamples(state);
    buttonsBelow(moment, settings);
}

void sidePanel(Moment& moment, const Box& place) {
    Ui& ui = moment.ui;
    ImGui::SetNextWindowPos({static_cast<float>(place.x), static_cast<float>(place.y)});
    ImGui::SetNextWindowSize({static_cast<float>(place.width), static_cast<float>(place.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("##side", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    tabs(moment);
    ImGui::PopStyleVar();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(14), ui.px(10)});
    ImGui::BeginChild("##tab", {0, 0}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoNav);
    ImGui::PopStyleVar();
    switch (moment.state.tab) {
    case Tab::techniques:
        techniquesTab(moment);
        break;
    case Tab::view:
        viewTab(moment);
        break;
    case Tab::measure:
        measureTab(moment);
        break;
    case Tab::study:
        studyTab(moment);
        break;
    }
    ImGui::EndChild();
    ImGui::End();
}

} // namespace obscura
