// Chooses a glTF file within the window.
#include "viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>

namespace obscura {

namespace {

namespace fs = std::filesystem;

struct Entry {
    fs::path path;
    bool folder = false;
    std::uintmax_t bytes = 0;
};

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool isScene(const fs::path& path) {
    const std::string extension = lower(path.extension().string());
    return extension == ".gltf" || extension == ".glb";
}

// Folders, then scenes, each by name; hidden ones are left out. What cannot be read is empty.
std::vector<Entry> entriesOf(const fs::path& folder, const std::string& filter) {
    std::vector<Entry> entries;
    std::error_code ignored;
    for (fs::directory_iterator at(folder, ignored), end; !ignored && at != end;
         at.increment(ignored)) {
        const std::string name = at->path().filename().string();
        std::error_code each;
        const bool inner = at->is_directory(each);
        if (name.starts_with('.') || (!inner && !isScene(at->path())) ||
            lower(name).find(lower(filter)) == std::string::npos)
            continue;
        entries.push_back({at->path(), inner, inner ? 0 : at->file_size(each)});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.folder != b.folder ? a.folder : a.path.filename() < b.path.filename();
    });
    return entries;
}

std::string sizeOf(std::uintmax_t bytes) {
    const double megabytes = static_cast<double>(bytes) / 1e6;
    return megabytes < 1 ? fmt::format("{:.0f} kB", std::ceil(static_cast<double>(bytes) / 1e3))
                         : fmt::format("{:.1f} MB", megabytes);
}

void enter(Browser& browser, const fs::path& folder) {
    browser.folder = folder;
    browser.filter.clear();
}

// The folders above, each a button.
void breadcrumbs(Ui& ui, Browser& browser) {
    std::vector<fs::path> parts;
    for (fs::path at = browser.folder; at != at.root_path(); at = at.parent_path())
        parts.push_back(at);
    parts.push_back(browser.folder.root_path());
    const float room = ImGui::GetContentRegionAvail().x;
    std::size_t shownParts = 0;
    float used = 0;
    for (; shownParts < parts.size(); ++shownParts) {
        used += ImGui::CalcTextSize(parts[shownParts].filename().c_str()).x + ui.px(40);
        if (used > room && shownParts > 0)
            break;
    }
    const fs::path folder = browser.folder;
    for (std::size_t i = shownParts; i-- > 0;) {
        const std::string name = parts[i].filename().empty() ? "/" : parts[i].filename().string();
        if (i + 1 < shownParts) {
            ImGui::SameLine(0, ui.px(2));
            ImGui::AlignTextToFramePadding();
            ImGui::TextDisabled("▸");
            ImGui::SameLine(0, ui.px(2));
        }
        if (button(ui, (name + "##" + parts[i].string()).c_str(), parts[i].string(), 0,
                   ButtonKind::quiet))
            enter(browser, parts[i]);
    }
}

void row(Ui& ui, const Entry& entry, Moment& moment, Browser& browser) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float full = ImGui::GetContentRegionAvail().x, height = ui.px(27);
    const std::string name = entry.path.filename().string();
    const bool pressed = ImGui::InvisibleButton(name.c_str(), {full, height});
    ui.note(("file " + name).c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (ImGui::IsItemHovered())
        list.AddRectFilled(low, {low.x + full, low.y + height}, colours::fieldHovered, ui.px(5));
    const float y = low.y + std::floor((height - ImGui::GetTextLineHeight()) / 2);
    list.AddText({low.x + ui.px(10), y}, entry.folder ? colours::warning : colours::accent,
                 entry.folder ? "▸" : "◆");
    const std::string size = entry.folder ? "" : sizeOf(entry.bytes);
    const float sizeWidth = ImGui::CalcTextSize(size.c_str()).x;
    list.AddText({low.x + ui.px(30), y}, colours::text,
                 fitted(name, full - sizeWidth - ui.px(60)).c_str());
    list.AddText({low.x + full - sizeWidth - ui.px(12), y}, colours::muted, size.c_str());
    if (!pressed)
        return;
    if (entry.folder)
        enter(browser, entry.path);
    else {
        moment.requests.open = SceneChoice{entry.path.string(), "", {}};
        browser.open = false;
    }
}

} // namespace

void browserPanel(Moment& moment, Browser& browser) {
    if (!browser.open)
        return;
    Ui& ui = moment.ui;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(ui.px(620), screen.x - ui.px(24));
    const float height = std::min(ui.px(500), screen.y - ui.px(24));
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({width, height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(18), ui.px(14)});
    if (!ImGui::IsPopupOpen("##browser"))
        ImGui::OpenPopup("##browser");
    if (ImGui::BeginPopupModal("##browser", nullptr,
                               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
        ImGui::PushFont(ui.theme.title);
        ImGui::TextUnformatted("Open a scene");
        ImGui::PopFont();
        ImGui::SameLine(width - ui.px(46));
        if (button(ui, "×##browser", "Close  (Esc)", ui.px(28), ButtonKind::quiet))
            browser.open = false;
        breadcrumbs(ui, browser);
        ImGui::SetNextItemWidth(-1);
        if (ImGui::IsWindowAppearing())
            ImGui::SetKeyboardFocusHere();
        ImGui::InputTextWithHint("##filter", "Type to filter", &browser.filter);
        if (ImGui::IsItemActive())
            ui.wake(0.3);
        ImGui::BeginChild("##files", {0, -ui.px(24)});
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ui.px(1)});
        const std::vector<Entry> entries = entriesOf(browser.folder, browser.filter);
        if (browser.folder != browser.folder.root_path() && browser.filter.empty())
            row(ui, {browser.folder / "..", true, 0}, moment, browser);
        for (const Entry& entry : entries)
            row(ui, entry, moment, browser);
        if (entries.empty())
            remark(ui, "No glTF file (.gltf, .glb) and no folder here.");
        ImGui::PopStyleVar();
        ImGui::EndChild();
        remark(ui, "glTF 2.0: .gltf and .glb. A file can also be dropped on the window.",
               colours::faint);
        if (!browser.open)
            ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar();
    if (browser.folder.filename() == "..")
        browser.folder = browser.folder.parent_path().parent_path();
}

} // namespace obscura
