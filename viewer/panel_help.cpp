// What lies over everything: the keys, and messages.
#include "viewer/panels.h"

#include <imgui.h>

#include <array>
#include <utility>

namespace obscura {

namespace {

using Line = std::pair<const char*, const char*>;
struct Group {
    const char* title;
    std::vector<Line> lines;
};

const std::array<std::vector<Group>, 2>& columns() {
    static const std::array<std::vector<Group>, 2> all{
        {{{"Mouse over a picture",
           {{"Left drag", "orbit round what is in the middle"},
            {"Right drag", "look around"},
            {"Middle or Shift drag", "shift"},
            {"Wheel", "nearer, farther"},
            {"Alt + wheel", "field of view"},
            {"Right button + wheel", "speed of flying"},
            {"Ctrl + wheel", "enlarge pixels"},
            {"Ctrl + drag", "move in the enlarged picture"}}},
          {"Fly",
           {{"W A S D", "forward, left, back, right"},
            {"Q E", "down, up"},
            {"Shift", "hurry"},
            {"L", "lock the cursor to look; L or Esc lets go"}}}},
         {{"Compare",
           {{"1 2 3 4 5 6", "one, split, side by side, four, flicker, difference"},
            {"Space", "the other one of a flicker"},
            {"X", "A and B change places"},
            {"[  ]", "the technique before, the next"},
            {"O", "lit, occlusion, albedo, normals, depth …"},
            {"T", "textures"},
            {"0", "all of the picture again"}}},
          {"Views and window",
           {{"C, Shift + C", "next view, the one before"},
            {"P", "store the view, for good"},
            {"F", "frame the scene"},
            {"Ctrl + O", "open a file; Esc gives up"},
            {"F12", "screenshot"},
            {"Tab", "panels on and off"},
            {"F1 or H", "this list"}}}}}};
    return all;
}

void group(Ui& ui, const Group& each) {
    ImGui::PushFont(ui.theme.bold);
    ImGui::TextUnformatted(each.title);
    ImGui::PopFont();
    for (const Line& line : each.lines) {
        const float x = ImGui::GetCursorPosX();
        ImGui::PushStyleColor(ImGuiCol_Text, colours::accent);
        ImGui::TextUnformatted(line.first);
        ImGui::PopStyleColor();
        ImGui::SameLine();
        ImGui::SetCursorPosX(x + ui.px(152));
        ImGui::PushStyleColor(ImGuiCol_Text, colours::muted);
        ImGui::TextUnformatted(line.second);
        ImGui::PopStyleColor();
    }
    ImGui::Dummy({0, ui.px(8)});
}

// All that lies below gets darker, and does not feel the mouse.
void dim(const ImVec2& screen) {
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(screen);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(0, 0, 0, 130));
    ImGui::SetNextWindowFocus();
    ImGui::Begin("##dim", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
    ImGui::End();
    ImGui::PopStyleColor();
}

} // namespace

void helpPanel(Moment& moment) {
    Ui& ui = moment.ui;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    dim(screen);
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {screen.x - ui.px(16), screen.y - ui.px(16)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(22), ui.px(16)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(9));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, colours::popup);
    ImGui::SetNextWindowFocus();
    ImGui::Begin("##keys", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
    const bool wide = screen.x > ui.px(960);
    ImGui::BeginGroup();
    for (const Group& each : columns()[0])
        group(ui, each);
    ImGui::EndGroup();
    if (wide)
        ImGui::SameLine(0, ui.px(34));
    ImGui::BeginGroup();
    for (const Group& each : columns()[1])
        group(ui, each);
    ImGui::EndGroup();
    ui.places["keys"] = {static_cast<double>(ImGui::GetWindowPos().x),
                         static_cast<double>(ImGui::GetWindowPos().y),
                         static_cast<double>(ImGui::GetWindowSize().x),
                         static_cast<double>(ImGui::GetWindowSize().y)};
    if (ImGui::IsMouseClicked(0))
        moment.state.help = false;
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
}

void messagePanel(Moment& moment, Message& message) {
    if (message.text.empty())
        return;
    Ui& ui = moment.ui;
    const Box& area = moment.area;
    const float width = std::min(ui.px(560), static_cast<float>(area.width) - ui.px(32));
    ImGui::SetNextWindowPos({static_cast<float>(area.x + area.width / 2),
                             static_cast<float>(area.bottom()) - ui.px(20)},
                            ImGuiCond_Always, {0.5F, 1});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(18), ui.px(12)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(8));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, colours::popup);
    ImGui::Begin("##message", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    ImGui::PushClipRect(low, {low.x + size.x, low.y + size.y}, false);
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + ui.px(4), low.y + size.y},
                                              message.error ? colours::danger : colours::accent,
                                              ui.px(8), ImDrawFlags_RoundCornersLeft);
    ImGui::PopClipRect();
    ImGui::PushTextWrapPos(width - ui.px(60));
    ImGui::TextUnformatted(message.text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::SameLine();
    ImGui::SetCursorPos({width - ui.px(42), ui.px(8)});
    if (button(ui, "×##message", "Close", ui.px(28), ButtonKind::quiet))
        message.text.clear();
    ui.places["message"] = {static_cast<double>(low.x), static_cast<double>(low.y),
                            static_cast<double>(size.x), static_cast<double>(size.y)};
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

} // namespace obscura
