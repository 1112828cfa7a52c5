// The tab of numbers: what each pass takes, how wrong each pane is, and what lies under the cursor.
#include "viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace obscura {

namespace {

constexpr std::array<ImU32, 4> workColours{IM_COL32(126, 132, 146, 255), colours::accent,
                                           IM_COL32(150, 128, 196, 255),
                                           IM_COL32(104, 170, 150, 255)};

// A pass after another, as wide as they take; `longest` fills the width.
void passBar(Ui& ui, const PaneDrawn& drawn, double longest, float height) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float full = ImGui::GetContentRegionAvail().x;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, {low.x + full, low.y + height}, colours::field, ui.px(3));
    float x = low.x;
    std::string tip = fmt::format("{:.3g} ms", drawn.ms);
    for (const PassDrawn& pass : drawn.passes) {
        const float width = longest > 0 ? static_cast<float>(pass.ms / longest) * full : 0;
        if (width > 0.5F)
            list.AddRectFilled({x, low.y}, {x + std::max(width - 1, 0.5F), low.y + height},
                               workColours[static_cast<std::size_t>(pass.work)], ui.px(2));
        x += width;
        tip += fmt::format("\n{:.3g} ms  {} ({})", pass.ms, pass.name,
                           workNames()[static_cast<std::size_t>(pass.work)]);
    }
    ImGui::InvisibleButton("##passes", {full, height});
    tooltip(ui, tip);
}

void historyLine(Ui& ui, const std::deque<float>& values, ImU32 colour, float height) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float full = ImGui::GetContentRegionAvail().x;
    ImGui::Dummy({full, height});
    if (values.size() < 2)
        return;
    const float top = *std::max_element(values.begin(), values.end());
    std::vector<ImVec2> points;
    const float step = full / static_cast<float>(History::kept - 1);
    for (std::size_t i = 0; i < values.size(); ++i)
        points.push_back({low.x + full - step * static_cast<float>(values.size() - 1 - i),
                          low.y + height - (top > 0 ? values[i] / top : 0) * (height - 2)});
    ImGui::GetWindowDrawList()->AddPolyline(points.data(), static_cast<int>(points.size()),
                                            faded(colour, 0.8F), 0, ui.px(1.2));
}

void paneTitle(Moment& moment, int place, const std::string& right) {
    Ui& ui = moment.ui;
    const int pane = paneAt(moment.state, place);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float full = ImGui::GetContentRegionAvail().x;
    const auto index = static_cast<std::size_t>(pane);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::PushFont(ui.theme.bold);
    list.AddText(at, colours::panes[index], letterOf(pane).c_str());
    ImGui::PopFont();
    const float width = ImGui::CalcTextSize(right.c_str()).x;
    const std::string title =
        fitted(std::string(moment.state.panes[index].technique().title), full - width - ui.px(30));
    list.AddText({at.x + ui.px(18), at.y}, colours::text, title.c_str());
    list.AddText({at.x + full - width, at.y}, colours::muted, right.c_str());
    ImGui::Dummy({full, ImGui::GetTextLineHeight()});
}

void workLegend(Ui& ui) {
    ImGui::PushFont(ui.theme.small);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImVec2 at = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetTextLineHeight(), dot = ui.px(7);
    for (std::size_t i = 0; i < workNames().size(); ++i) {
        const float top = at.y + (line - dot) / 2;
        list.AddRectFilled({at.x, top}, {at.x + dot, top + dot}, workColours[i], ui.px(2));
        list.AddText({at.x + ui.px(12), at.y}, colours::muted, workNames()[i].c_str());
        at.x += ui.px(28) + ImGui::CalcTextSize(workNames()[i].c_str()).x;
    }
    ImGui::Dummy({0, line});
    ImGui::PopFont();
}

void times(Moment& moment) {
    Ui& ui = moment.ui;
    const Drawn& drawn = *moment.drawn;
    heading(ui, "Times");
    double longest = 0;
    for (const PaneDrawn& pane : drawn.panes)
        longest = std::max(longest, pane.ms);
    for (int pane = 0; pane < static_cast<int>(drawn.panes.size()); ++pane) {
        const auto index = static_cast<std::size_t>(pane);
        ImGui::PushID(pane);
        paneTitle(moment, pane, fmt::format("{:.3g} ms", drawn.panes[index].ms));
        passBar(ui, drawn.panes[index], longest, ui.px(9));
        historyLine(ui, moment.history.panes[index].ms,
                    colours::panes[static_cast<std::size_t>(paneAt(moment.state, pane))],
                    ui.px(20));
        ImGui::PopID();
    }
    workLegend(ui);
    fact(ui, "G-buffer and light",
         fmt::format("{:.3g} + {:.3g} ms", drawn.gbufferMs, drawn.lightMs));
    fact(ui, "Whole picture", fmt::format("{:.3g} ms", wholeMs(drawn)),
         "G-buffer, light and all techniques\nWhat has not changed is not drawn again");
}

void qualityTable(Moment& moment) {
    Ui& ui = moment.ui;
    if (!ImGui::BeginTable("##quality", 4, ImGuiTableFlags_None))
        return;
    ImGui::TableSetupColumn("##pane", ImGuiTableColumnFlags_WidthStretch, 1.6F);
    for (const char* name : {"RMSE", "FLIP", "JOD"})
        ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableNextRow();
    ImGui::PushStyleColor(ImGuiCol_Text, colours::muted);
    const std::array<const char*, 4> tips{
        "", "Of visibility, against the reference\nLess is better",
        "Mean FLIP of the lit picture, against the one with the reference\nLess is better",
        "Predicted quality of the lit picture in just-objectionable differences\n10 looks the same "
        "(ColorVideoVDP)"};
    for (int column = 1; column < 4; ++column) {
        ImGui::TableSetColumnIndex(column);
        ImGui::TextUnformatted(ImGui::TableGetColumnName(column));
        tooltip(ui, tips[static_cast<std::size_t>(column)]);
    }
    ImGui::PopStyleColor();
    for (int place = 0; place < static_cast<int>(moment.drawn->panes.size()); ++place) {
        const auto& quality = moment.drawn->panes[static_cast<std::size_t>(place)].quality;
        const int pane = paneAt(moment.state, place);
        ImGui::TableNextRow();
        ImGui::TableSetColumnIndex(0);
        ImGui::PushFont(ui.theme.bold);
        ImGui::PushStyleColor(ImGuiCol_Text, colours::panes[static_cast<std::size_t>(pane)]);
        ImGui::TextUnformatted(letterOf(pane).c_str());
        ImGui::PopStyleColor();
        ImGui::PopFont();
        const std::array<std::string, 3> words =
            quality ? std::array<std::string, 3>{fmt::format("{:.4f}", quality->rmse),
                                                 fmt::format("{:.4f}", quality->flip),
                                                 fmt::format("{:.2f}", quality->jod)}
                    : std::array<std::string, 3>{"–", "–", "–"};
        for (int column = 1; column < 4; ++column) {
            ImGui::TableSetColumnIndex(column);
            ImGui::TextUnformatted(words[static_cast<std::size_t>(column - 1)].c_str());
        }
    }
    ImGui::EndTable();
}

void reference(Moment& moment) {
    Ui& ui = moment.ui;
    State& state = moment.state;
    heading(ui, "Against the reference");
    toggle(ui, "Trace the reference", state.reference,
           "By rays, in the background, ever finer while one looks\nError and visible error do "
           "so anyway");
    static const std::vector<std::string> integrals{"Cosine", "Uniform", "Falloff"};
    int integral = static_cast<int>(state.integral);
    if (segments(ui, "Integral", integrals, integral,
                 "Of visibility over the hemisphere\nWeighted by the cosine, evenly, or with "
                 "occlusion that fades with distance"))
        state.integral = static_cast<Integral>(integral);
    std::vector<std::string> names;
    std::vector<std::string> tips;
    for (const Display& display : displays()) {
        names.push_back(inWords(std::string_view(display.name)));
        tips.push_back(inWords(display));
    }
    choice(ui, "Display", names, state.display, tips);
    slider(ui,
           {"Scale of errors", errorScales(), 0.25, Unit::ratio,
            "The error, or difference, that has the last colour of the map\nDrag over the legend "
            "to change it"},
           state.errorScale);
    if (!moment.drawn)
        return;
    if (moment.drawn->referenceRays > 0)
        fact(ui, "Rays a pixel", std::to_string(moment.drawn->referenceRays));
    qualityTable(moment);
}

void pixel(Moment& moment) {
    Ui& ui = moment.ui;
    heading(ui, "Pixel under the cursor");
    if (!moment.probed) {
        remark(ui, "Move over a picture to see every buffer's value at a pixel.");
        return;
    }
    const Probed& p = *moment.probed;
    const auto triple = [](const glm::vec3& v) {
        return fmt::format("{:.3f}  {:.3f}  {:.3f}", v.x, v.y, v.z);
    };
    fact(ui, "Pixel", fmt::format("{}, {}", p.x, p.y));
    if (p.surface) {
        fact(ui, "Depth", fmt::format("{:.4g} m", p.depth));
        fact(ui, "Position", triple(p.position));
        if (p.normal)
            fact(ui, "Normal", triple(*p.normal));
        if (p.albedo)
            fact(ui, "Base colour", triple(*p.albedo));
        if (p.reference)
            fact(ui, "Reference", fmt::format("{:.4f}", *p.reference));
    } else
        remark(ui, "No surface here.");
    for (int pane = 0; pane < static_cast<int>(p.panes.size()); ++pane) {
        const Probed::Pane& each = p.panes[static_cast<std::size_t>(pane)];
        ImGui::PushID(pane);
        ImGui::Dummy({0, ui.px(2)});
        paneTitle(moment, pane, fmt::format("{:.4f}", each.visibility));
        if (each.lit)
            fact(ui, "Shown, of 255",
                 fmt::format("{:.0f}  {:.0f}  {:.0f}", each.lit->x, each.lit->y, each.lit->z));
        for (const Probed::Pass& pass : each.passes) {
            std::string values;
            for (int i = 0; i < pass.channels; ++i)
                values += fmt::format("{}{:.4g}", i > 0 ? "  " : "",
                                      pass.value[static_cast<std::size_t>(i)]);
            fact(ui, pass.name.c_str(), values);
        }
        ImGui::PopID();
    }
}

} // namespace

Scale errorScales() { return scaleBetween(0.005, 1); }

double wholeMs(const Drawn& drawn) {
    double ms = drawn.gbufferMs + drawn.lightMs;
    for (const PaneDrawn& pane : drawn.panes)
        ms += pane.ms;
    return ms;
}

void History::add(const Drawn& drawn) {
    if (drawn.number == number)
        return;
    number = drawn.number;
    for (std::size_t i = 0; i < drawn.panes.size(); ++i) {
        const std::string id(drawn.wanted.panes[i].technique().id);
        if (panes[i].technique != id)
            panes[i] = {id, {}};
        panes[i].ms.push_back(static_cast<float>(drawn.panes[i].ms));
        if (panes[i].ms.size() > kept)
            panes[i].ms.pop_front();
    }
}

void measureTab(Moment& moment) {
    if (moment.drawn)
        times(moment);
    reference(moment);
    pixel(moment);
}

} // namespace obscura
