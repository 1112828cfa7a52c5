// The bar above the pictures: which scene, how pictures are compared, what they show; and the line
// below them: what goes on, where the camera is.
#include "renderer/builtin/builtin.h"
#include "viewer/navigation.h"
#include "viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

namespace obscura {

namespace {

// Pictures of the layouts: what they do to a picture with two halves.
void drawLayout(Ui& ui, Layout layout, const ImVec2& centre, ImU32 colour) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float w = ui.px(9), h = ui.px(6), thin = std::max(1.0F, std::round(ui.px(1)));
    const ImVec2 low{std::round(centre.x - w) + 0.5F, std::round(centre.y - h) + 0.5F};
    const ImVec2 high{std::round(centre.x + w) + 0.5F, std::round(centre.y + h) + 0.5F};
    const float x = std::round(centre.x), y = std::round(centre.y), gap = ui.px(1.5);
    switch (layout) {
    case Layout::single:
        list.AddRect(low, high, colour, ui.px(2), 0, thin);
        break;
    case Layout::split:
        list.AddRect(low, high, colour, ui.px(2), 0, thin);
        list.AddRectFilled({x, low.y}, high, colour, ui.px(2), ImDrawFlags_RoundCornersRight);
        break;
    case Layout::sideBySide:
        list.AddRect(low, {x - gap, high.y}, colour, ui.px(1.5), 0, thin);
        list.AddRectFilled({x + gap, low.y}, high, colour, ui.px(1.5));
        break;
    case Layout::grid:
        for (const auto& [left, top] :
             {std::pair{low.x, low.y}, {x + gap, low.y}, {low.x, y + gap}, {x + gap, y + gap}})
            list.AddRectFilled({left, top}, {left + w - gap, top + h - gap}, colour, ui.px(1));
        break;
    case Layout::flicker:
        list.AddRect({low.x + ui.px(4), low.y}, high, colour, ui.px(2), 0, thin);
        list.AddRectFilled({low.x, low.y + ui.px(4)}, {high.x - ui.px(4), high.y + ui.px(2)},
                           colour, ui.px(2));
        break;
    case Layout::difference:
        list.AddCircle({x - ui.px(3.5), centre.y}, ui.px(5.5), colour, 24, thin);
        list.AddCircle({x + ui.px(3.5), centre.y}, ui.px(5.5), colour, 24, thin);
        list.AddLine({x, centre.y - ui.px(3)}, {x, centre.y + ui.px(3)}, colour, ui.px(3));
        break;
    }
}

void layoutButtons(Moment& moment) {
    static const std::array<const char*, 6> tips{
        "One picture  (1)\nA alone",
        "Split  (2)\nA on the left of a divider that can be dragged, B on the right",
        "Side by side  (3)\nA and B with the same camera",
        "Four  (4)\nA, B, C and D with the same camera",
        "Flicker  (5)\nA and B in one place; Space goes from one to the other",
        "Difference  (6)\nA minus B, with a scale"};
    Ui& ui = moment.ui;
    const ImVec2 size{ui.px(34), ui.px(27)};
    for (int i = 0; i < static_cast<int>(tips.size()); ++i) {
        const auto layout = static_cast<Layout>(i);
        const std::string& name = layoutNames()[static_cast<std::size_t>(i)];
        if (i > 0)
            ImGui::SameLine(0, 0);
        const ImVec2 low = ImGui::GetCursorScreenPos(), high{low.x + size.x, low.y + size.y};
        if (ImGui::InvisibleButton(name.c_str(), size))
            moment.state.layout = layout;
        ui.note(name.c_str());
        const bool hovered = ImGui::IsItemHovered(), on = moment.state.layout == layout;
        tooltip(ui, tips[static_cast<std::size_t>(i)]);
        if (on || hovered)
            ImGui::GetWindowDrawList()->AddRectFilled(
                {low.x + 1, low.y}, {high.x - 1, high.y},
                on ? colours::accentDim : colours::fieldHovered, ui.px(5));
        drawLayout(ui, layout, {(low.x + high.x) / 2, (low.y + high.y) / 2},
                   on ? colours::text : colours::muted);
    }
}

void sceneMenu(Moment& moment) {
    Ui& ui = moment.ui;
    const std::string name = fitted(nameOf(moment.state.scene), ui.px(150), true);
    if (button(ui, (name + "  ▾##scene").c_str(), "Scene\nOpen another one; or drop a glTF here"))
        ImGui::OpenPopup("##scenes");
    ui.note("scene");
    ImGui::SetNextWindowPos({ImGui::GetItemRectMin().x, ImGui::GetItemRectMax().y + ui.px(4)});
    if (!ImGui::BeginPopup("##scenes"))
        return;
    if (ImGui::MenuItem("Open a file…", "Ctrl+O"))
        moment.requests.browse = true;
    ui.note("Open a file…");
    ImGui::Separator();
    ImGui::PushFont(ui.theme.small);
    ImGui::TextDisabled("Built in");
    ImGui::PopFont();
    for (const std::string& builtin : builtinSceneNames()) {
        if (ImGui::MenuItem(builtin.c_str(), nullptr, moment.state.scene.builtin == builtin))
            moment.requests.open = SceneChoice{"", builtin, {}};
        ui.note(("scene " + builtin).c_str());
    }
    ImGui::EndPopup();
}

const std::array<const char*, 7> showTips{
    "As a stimulus shows it",
    "Visibility as grey",
    "Base colour",
    "Red, green and blue are x, y and z of the normal in world space",
    "Near is pale, far is dark",
    "Against the traced reference: red where too bright, blue where too dark",
    "Where a person would see that the lit picture is not the reference's (ColorVideoVDP)"};
const std::array<std::string, 7> showWords{"Lit",   "Occlusion", "Albedo",       "Normals",
                                           "Depth", "Error",     "Visible error"};

void beginStrip(const char* name, const Box& place, float padX, float padY) {
    ImGui::SetNextWindowPos({static_cast<float>(place.x), static_cast<float>(place.y)});
    ImGui::SetNextWindowSize({static_cast<float>(place.width), static_cast<float>(place.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {padX, padY});
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
}

std::string leftOf(const Status& status) {
    if (!std::isfinite(status.secondsLeft) || status.secondsLeft < 0.5)
        return "";
    return status.secondsLeft < 90 ? fmt::format(", {:.0f} s left", status.secondsLeft)
                                   : fmt::format(", {:.0f} min left", status.secondsLeft / 60);
}

// Of slow work alone: at 30 pictures a second nobody reads "drawing".
std::string doingOf(const Status& status) {
    switch (status.doing) {
    case Status::Doing::loading:
        return "Loading " + status.what;
    case Status::Doing::compiling:
        return "Preparing " + status.what;
    case Status::Doing::tracing:
        return "Tracing " + status.what;
    case Status::Doing::drawing:
    case Status::Doing::nothing:
        break;
    }
    return "";
}

void rightAligned(float& right, float middle, const std::string& text, ImU32 colour, Ui& ui,
                  float limit) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    if (right - size.x < limit)
        return;
    right -= size.x;
    ImGui::GetWindowDrawList()->AddText({right, std::floor(middle - size.y / 2)}, colour,
                                        text.c_str());
    right -= ui.px(18);
}

} // namespace

std::string letterOf(int pane) { return std::string(1, static_cast<char>('A' + pane)); }

void barPanel(Moment& moment, const Box& place) {
    Ui& ui = moment.ui;
    beginStrip("##bar", place, ui.px(10), ui.px(7));
    sceneMenu(moment);
    ImGui::SameLine(0, ui.px(14));
    layoutButtons(moment);
    ImGui::SameLine(0, ui.px(14));
    ImGui::BeginChild("##show", {ui.px(132), ui.px(30)}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    int show = static_cast<int>(moment.state.show);
    const std::vector<std::string> tips(showTips.begin(), showTips.end());
    if (choice(ui, "##show", showWords, show, tips))
        moment.state.show = static_cast<Show>(show);
    ImGui::EndChild();
    const float side = ui.px(28);
    ImGui::SameLine();
    ImGui::SetCursorPosX(static_cast<float>(place.width) - 2 * side - ui.px(16));
    if (button(ui, "?##help", "Keys and mouse  (F1)", side, ButtonKind::quiet, moment.state.help))
        moment.state.help = !moment.state.help;
    ImGui::SameLine(0, ui.px(6));
    if (button(ui, "☰##panels", "Hide panels  (Tab)", side, ButtonKind::quiet))
        moment.state.panels = false;
    ImGui::End();
}

void statusPanel(Moment& moment, const Box& place) {
    Ui& ui = moment.ui;
    beginStrip("##status", place, ui.px(12), 0);
    ImGui::PushFont(ui.theme.small);
    const float middle = static_cast<float>(place.y + place.height / 2);
    const Vec3& at = moment.state.view.camera.position;
    float right = static_cast<float>(place.right()) - ui.px(12);
    const float half = static_cast<float>(place.x + place.width * 0.42);
    if (moment.drawn) {
        // At rest, what everything would take.
        const double ms =
            moment.drawn->intervalMs > 0 ? moment.drawn->intervalMs : wholeMs(*moment.drawn);
        rightAligned(right, middle, fmt::format("{:.1f} FPS", ms > 0 ? 1000 / ms : 0),
                     colours::text, ui, half);
        rightAligned(
            right, middle,
            fmt::format("{} × {}", moment.drawn->wanted.width, moment.drawn->wanted.height),
            colours::muted, ui, half);
    }
    rightAligned(right, middle, fmt::format("{:.4g}°", moment.state.view.camera.fovDegrees),
                 colours::muted, ui, half);
    rightAligned(right, middle, fmt::format("x {:.2f}   y {:.2f}   z {:.2f}", at[0], at[1], at[2]),
                 colours::muted, ui, half);
    const std::string doing = doingOf(moment.status);
    const float x = static_cast<float>(place.x) + ui.px(12);
    float textX = x;
    if (!doing.empty()) {
        ImGui::SetCursorScreenPos({x, middle - ui.px(2)});
        progressBar(ui, moment.status.share, ui.px(90), ui.px(4));
        textX += ui.px(102);
    }
    const std::string words =
        doing.empty() ? (moment.cursorLocked ? "Cursor locked: L or Esc lets go" : "Ready")
                      : doing + leftOf(moment.status);
    const std::string text = fitted(words, right - textX - ui.px(8));
    ImGui::GetWindowDrawList()->AddText(
        {textX, std::floor(middle - ImGui::GetTextLineHeight() / 2)},
        doing.empty() ? colours::faint : colours::text, text.c_str());
    ImGui::PopFont();
    ImGui::End();
}

} // namespace obscura
