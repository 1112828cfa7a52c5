// The tab that leads from the window to studies: pairs, cameras, screenshots, and the test mode.
#include "viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

namespace obscura {

namespace {

void pathField(Ui& ui, const char* label, std::string& path, const char* tip) {
    const std::string name = shown(label);
    ImGui::PushStyleColor(ImGuiCol_Text, colours::muted);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(name.c_str());
    ImGui::PopStyleColor();
    ImGui::SameLine(ui.px(80));
    ImGui::SetNextItemWidth(-1);
    ImGui::InputText(("##" + name).c_str(), &path);
    ui.note(label);
    if (ImGui::IsItemActive())
        ui.wake(0.3);
    else
        tooltip(ui, tip);
}

std::string viewsOf(const State& state) {
    return fmt::format("{} view{}", state.views.size(), state.views.size() == 1 ? "" : "s");
}

void pair(Moment& moment) {
    Ui& ui = moment.ui;
    heading(ui, "To a study");
    pathField(ui, "Protocol", moment.desk.protocol,
              "A protocol of yours, or a new file\nIt is read back before it replaces anything");
    const bool two = panesOf(moment.state.layout) == 2;
    ImGui::BeginDisabled(!two);
    if (button(ui, "Add A and B as a condition",
               two ? "People will be shown this pair\nScene, light and techniques are added where "
                     "the protocol has none like them"
                   : "A pair is two panes: choose split, side by side, flicker or difference",
               -1))
        moment.requests.addPair = true;
    ImGui::EndDisabled();
    if (button(ui, "Copy settings as TOML", "Scene, light and techniques, for a protocol", -1))
        moment.requests.copySettings = true;
    ImGui::Dummy({0, ui.px(2)});
    pathField(ui, "Sweep", moment.desk.sweep, "A new file for obscura-bench sweep");
    const bool several = moment.state.views.size() > 1;
    ImGui::BeginDisabled(!several);
    if (button(ui, fmt::format("{} for a sweep##sweep", viewsOf(moment.state)).c_str(),
               several ? "The views of the list and the techniques of the panes, as a study that "
                         "obscura-bench sweep takes"
                       : "A sweep wants two views or more: P stores the present one",
               -1))
        moment.requests.writeSweep = true;
    ImGui::EndDisabled();
}

void screenshots(Moment& moment) {
    Ui& ui = moment.ui;
    heading(ui, "Screenshots");
    pathField(ui, "Folder", moment.desk.pictures, "Made when it is needed");
    if (button(ui, "Save each pane",
               "PNG as shown, and EXR of visibility; named by settings  (F12)", -1))
        moment.requests.screenshot = true;
}

void running(Moment& moment) {
    Ui& ui = moment.ui;
    const TestRun& run = *moment.test;
    progressBar(ui, run.share(), ImGui::GetContentRegionAvail().x, ui.px(5));
    remark(ui, run.now());
    if (button(ui, "Stop", "Whole rounds are kept", -1))
        moment.requests.stopTest = true;
}

void table(Ui& ui, const std::string& text, bool failed) {
    ImGui::PushFont(failed ? ui.theme.text : ui.theme.mono);
    ImGui::PushStyleColor(ImGuiCol_Text, failed ? colours::danger : colours::text);
    if (failed)
        ImGui::PushTextWrapPos(0);
    if (failed)
        ImGui::TextUnformatted(text.c_str());
    else {
        const float lines = static_cast<float>(std::count(text.begin(), text.end(), '\n') + 2);
        ImGui::BeginChild("##leeds", {0, lines * ImGui::GetTextLineHeightWithSpacing()}, false,
                          ImGuiWindowFlags_HorizontalScrollbar);
        ImGui::TextUnformatted(text.c_str());
        ImGui::EndChild();
    }
    if (failed)
        ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void test(Moment& moment) {
    Ui& ui = moment.ui;
    State& state = moment.state;
    heading(ui, "Test mode");
    const int panes = panesOf(state.layout);
    remark(ui,
           fmt::format("Frames per second of {} technique{} from {}, in random order, as in the "
                       "Leeds thesis.",
                       panes, panes == 1 ? "" : "s", viewsOf(state)));
    if (moment.test && !moment.test->finished()) {
        running(moment);
        return;
    }
    slider(ui,
           {"Seconds of each", scaleBetween(0.5, 30), 5, Unit::ratio,
            "How long each technique is drawn from each view in each round"},
           moment.desk.seconds);
    slider(ui, {"Rounds", scaleBetween(1, 10, true), 3, Unit::count, "Each in another order"},
           moment.desk.rounds);
    pathField(ui, "Results", moment.desk.out, "A folder that has no results yet");
    const double seconds = moment.desk.seconds * moment.desk.rounds * panesOf(state.layout) *
                           static_cast<double>(state.views.size());
    if (button(ui,
               fmt::format("Start, about {}##test", seconds < 120
                                                        ? fmt::format("{:.0f} s", seconds)
                                                        : fmt::format("{:.0f} min", seconds / 60))
                   .c_str(),
               "test.csv, passes.csv, table.txt, and a screenshot of each", -1,
               ButtonKind::primary))
        moment.requests.startTest = true;
    ui.note("Start test");
    if (moment.test)
        table(ui, moment.test->outcome(), moment.test->failed());
}

} // namespace

void studyTab(Moment& moment) {
    pair(moment);
    screenshots(moment);
    test(moment);
}

} // namespace obscura
