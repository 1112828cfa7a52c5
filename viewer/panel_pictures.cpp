// The pictures themselves, with what lies on them: captions, the divider, legends.
#include "gl/target.h"
#include "viewer/navigation.h"
#include "viewer/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

ImVec2 lowOf(const Box& box) { return {static_cast<float>(box.x), static_cast<float>(box.y)}; }
ImVec2 highOf(const Box& box) {
    return {static_cast<float>(box.right()), static_cast<float>(box.bottom())};
}

std::shared_ptr<const SharedPicture> pictureOf(const Drawn& drawn, int pane) {
    if (pane < 0)
        return drawn.difference;
    return pane < static_cast<int>(drawn.panes.size())
               ? drawn.panes[static_cast<std::size_t>(pane)].picture
               : nullptr;
}

// Pixel by pixel where pixels can be told apart; smoothly where a reduced picture is spread out.
void drawPicture(const Moment& moment, const PlacedPane& pane) {
    const std::shared_ptr<const SharedPicture> picture =
        moment.drawn ? pictureOf(*moment.drawn, pane.pane) : nullptr;
    if (!picture || pane.clip.width <= 0)
        return;
    const Magnification& magnification = moment.state.magnification;
    const Box part = shownPart(magnification);
    const gl::Texture& texture = moment.uploads.of(picture);
    gl::filterLinearly(texture,
                       magnification.factor < 2 && picture->width != std::lround(pane.place.width));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(lowOf(pane.clip), highOf(pane.clip), true);
    // ImGui carries numbers as pointers. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto id = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture.name()));
    list.AddImage(id, lowOf(pane.place), highOf(pane.place),
                  {static_cast<float>(part.x), static_cast<float>(1 - part.y)},
                  {static_cast<float>(part.right()), static_cast<float>(1 - part.bottom())});
    list.PopClipRect();
}

std::string figuresOf(const Moment& moment, int pane) {
    if (!moment.drawn || pane < 0 || pane >= static_cast<int>(moment.drawn->panes.size()))
        return "";
    const PaneDrawn& drawn = moment.drawn->panes[static_cast<std::size_t>(pane)];
    std::string text =
        drawn.rays > 0 ? fmt::format("{} rays", drawn.rays) : fmt::format("{:.3g} ms", drawn.ms);
    if (drawn.waits)
        text += "  ·  waiting for rays";
    if (drawn.quality)
        text += fmt::format("  ·  RMSE {:.3f}  ·  FLIP {:.3f}  ·  {:.2f} JOD", drawn.quality->rmse,
                            drawn.quality->flip, drawn.quality->jod);
    return text;
}

// Letter and title, and below it what it costs and how wrong it is.
void caption(Moment& moment, const PlacedPane& pane, bool right) {
    Ui& ui = moment.ui;
    const int shown = paneAt(moment.state, std::max(pane.pane, 0));
    const Settings& settings = moment.state.panes[static_cast<std::size_t>(shown)];
    const float room = static_cast<float>(pane.clip.width) - ui.px(20);
    if (room < ui.px(60))
        return;
    std::string title(settings.technique().title);
    ImGui::PushFont(ui.theme.small);
    std::string figures = fitted(figuresOf(moment, pane.pane), room - ui.px(20));
    const float figuresWidth = ImGui::CalcTextSize(figures.c_str()).x;
    const float smallLine = ImGui::GetTextLineHeight();
    ImGui::PopFont();
    if (ImGui::CalcTextSize(title.c_str()).x > room - ui.px(40)) // rather short than cut
        title = fitted(std::string(settings.technique().id), room - ui.px(40));
    const float line = ImGui::GetTextLineHeight();
    const float width =
        std::max(ImGui::CalcTextSize(title.c_str()).x + ui.px(20), figuresWidth) + ui.px(18);
    const float height = line + (figures.empty() ? 0 : smallLine + ui.px(3)) + ui.px(12);
    const float x = std::floor(right ? static_cast<float>(pane.clip.right()) - width - ui.px(10)
                                     : static_cast<float>(pane.clip.x) + ui.px(10));
    const float y = static_cast<float>(pane.clip.y) + ui.px(10);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({x, y}, {x + width, y + height}, faded(colours::backdrop, 0.78F), ui.px(6));
    ImGui::PushFont(ui.theme.bold);
    list.AddText({x + ui.px(9), y + ui.px(6)}, colours::panes[static_cast<std::size_t>(shown)],
                 letterOf(shown).c_str());
    ImGui::PopFont();
    list.AddText({x + ui.px(27), y + ui.px(6)}, colours::text, title.c_str());
    ImGui::PushFont(ui.theme.small);
    list.AddText({x + ui.px(9), y + ui.px(9) + line}, colours::muted, figures.c_str());
    ImGui::PopFont();
    ui.places["caption " + letterOf(shown)] = {static_cast<double>(x), static_cast<double>(y),
                                               static_cast<double>(width),
                                               static_cast<double>(height)};
}

// The colours that an error, JOD or difference has, and what they mean. Dragging over it changes
// the scale.
class Legend {
  public:
    Legend(Moment& moment, bool difference)
        : moment_(moment), ui_(moment.ui), difference_(difference),
          error_(difference || moment.state.show == Show::error), width_(ui_.px(190)) {
        const Box& area = moment.area;
        x_ = std::floor(static_cast<float>(area.x + area.width / 2) - width_ / 2);
        y_ = static_cast<float>(area.bottom()) - ui_.px(54);
    }

    void draw() {
        ImGui::SetCursorScreenPos({x_ - ui_.px(14), y_ - ui_.px(9)});
        ImGui::InvisibleButton("##legend", {width_ + ui_.px(28), ui_.px(52)});
        ui_.note("legend");
        const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        if (error_)
            drag();
        ImGui::GetWindowDrawList()->AddRectFilled(
            low, high, faded(colours::backdrop, ImGui::IsItemHovered() ? 0.95F : 0.82F), ui_.px(6));
        drawMap();
        ImGui::PushFont(ui_.theme.small);
        const std::string scale = fmt::format("{:.2g}", moment_.state.errorScale);
        put(0, 3, error_ ? "−" + scale : "10 JOD", colours::text);
        put(1, 3, error_ ? "+" + scale : "7 JOD", colours::text);
        if (error_)
            put(0.5F, 3, "0", colours::text);
        put(0.5F, 17,
            !error_       ? "none seen … clearly seen"
            : difference_ ? "A darker … B darker"
                          : "too bright … too dark",
            colours::muted);
        ImGui::PopFont();
    }

  private:
    void drag() {
        const float moved = ImGui::GetIO().MouseDelta.x;
        double& scale = moment_.state.errorScale;
        if (ImGui::IsItemActive() && moved != 0)
            scale = valueAt(errorScales(), positionOf(errorScales(), scale) +
                                               static_cast<double>(moved / width_) / 2);
        if (ImGui::IsItemHovered())
            ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        tooltip(ui_, ImGui::IsItemActive() ? "" : "Drag to change the scale");
    }
    void drawMap() {
        constexpr int steps = 64;
        static const auto errors = errorColours(steps), jods = jodColours(steps);
        for (int i = 0; i < steps; ++i) {
            const auto& c = (error_ ? errors : jods)[static_cast<std::size_t>(i)];
            const float from = x_ + width_ * static_cast<float>(i) / steps;
            ImGui::GetWindowDrawList()->AddRectFilled({from, y_},
                                                      {from + width_ / steps + 1, y_ + ui_.px(8)},
                                                      IM_COL32(c[0], c[1], c[2], 255));
        }
    }
    void put(float share, float row, const std::string& text, ImU32 colour) {
        const float size = ImGui::CalcTextSize(text.c_str()).x;
        ImGui::GetWindowDrawList()->AddText(
            {std::floor(x_ + share * (width_ - size)), y_ + ui_.px(8) + ui_.px(row)}, colour,
            text.c_str());
    }

    Moment& moment_;
    Ui& ui_;
    bool difference_, error_;
    float width_, x_ = 0, y_ = 0;
};

void legend(Moment& moment) {
    const bool difference = moment.state.layout == Layout::difference;
    if (difference || moment.state.show == Show::error || moment.state.show == Show::jod)
        Legend(moment, difference).draw();
}

void dragDivider(Moment& moment) {
    Ui& ui = moment.ui;
    const Box& area = moment.area;
    const float reach = ui.px(9);
    const float x = static_cast<float>(area.x + std::round(area.width * moment.state.divider));
    ImGui::SetCursorScreenPos({x - reach, static_cast<float>(area.y)});
    ImGui::InvisibleButton("##divider", {2 * reach, static_cast<float>(area.height)});
    ui.note("divider");
    const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (hot)
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0)
        moment.state.divider = std::clamp(
            (static_cast<double>(ImGui::GetIO().MousePos.x) - area.x) / area.width, 0.0, 1.0);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0))
        moment.state.divider = 0.5;
    const float now = static_cast<float>(area.x + std::round(area.width * moment.state.divider));
    const float middle = static_cast<float>(area.y + area.height / 2);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({now - ui.px(1), static_cast<float>(area.y)},
                       {now + ui.px(1), static_cast<float>(area.bottom())},
                       faded(IM_COL32_WHITE, hot ? 0.95F : 0.7F));
    list.AddRectFilled({now - ui.px(11), middle - ui.px(15)}, {now + ui.px(11), middle + ui.px(15)},
                       hot ? colours::accent : faded(colours::backdrop, 0.85F), ui.px(7));
    for (const float side : {-1.0F, 1.0F})
        list.AddTriangleFilled({now + side * ui.px(7), middle},
                               {now + side * ui.px(3), middle - ui.px(4)},
                               {now + side * ui.px(3), middle + ui.px(4)}, colours::text);
}

// Left turns the scene, middle shifts it, right turns the head; with Control the enlarged picture
// is shifted.
void dragCamera(Moment& moment, Hand& hand) {
    const ImGuiIO& io = ImGui::GetIO();
    Camera& camera = moment.state.view.camera;
    const double height = std::max(moment.area.height, 1.0);
    const double right = static_cast<double>(io.MouseDelta.x) / height;
    const double down = static_cast<double>(io.MouseDelta.y) / height;
    hand.looking = io.MouseDown[1];
    if (right == 0 && down == 0)
        return;
    if (io.KeyCtrl)
        moment.state.magnification =
            shifted(moment.state.magnification,
                    static_cast<double>(io.MouseDelta.x) / moment.area.width, down);
    else if (io.MouseDown[1])
        camera = looked(camera, right * 2, -down * 2);
    else if (io.MouseDown[2] || (io.MouseDown[0] && io.KeyShift))
        camera = panned(camera, right, -down);
    else if (io.MouseDown[0])
        camera = orbited(camera, right * 4, -down * 4);
}

void turnWheel(Moment& moment, const std::vector<PlacedPane>& placed) {
    const ImGuiIO& io = ImGui::GetIO();
    const double notches = static_cast<double>(io.MouseWheel);
    if (notches == 0)
        return;
    State& state = moment.state;
    if (io.KeyCtrl) {
        for (const PlacedPane& pane : placed)
            if (pane.clip.contains(static_cast<double>(io.MousePos.x),
                                   static_cast<double>(io.MousePos.y)))
                state.magnification = magnified(
                    state.magnification, std::pow(1.5, notches),
                    (static_cast<double>(io.MousePos.x) - pane.place.x) / pane.place.width,
                    (static_cast<double>(io.MousePos.y) - pane.place.y) / pane.place.height);
    } else if (io.KeyAlt)
        state.view.camera = zoomed(state.view.camera, std::pow(1.1, notches));
    else if (io.MouseDown[1])
        state.speed = nextSpeed(state.speed, notches);
    else
        state.view.camera = dollied(state.view.camera, std::pow(0.9, notches));
}

void centred(Ui& ui, const Box& area, const std::string& text, const std::string& below) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float x = static_cast<float>(area.x + area.width / 2);
    const float y = static_cast<float>(area.y + area.height / 2);
    ImGui::PushFont(ui.theme.title);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list.AddText({std::floor(x - size.x / 2), std::floor(y - size.y)}, colours::muted,
                 text.c_str());
    ImGui::PopFont();
    const ImVec2 small = ImGui::CalcTextSize(below.c_str());
    list.AddText({std::floor(x - small.x / 2), std::floor(y + ui.px(8))}, colours::faint,
                 below.c_str());
}

} // namespace

Hand picturesPanel(Moment& moment) {
    Ui& ui = moment.ui;
    const Box& area = moment.area;
    Hand hand;
    ImGui::SetNextWindowPos(lowOf(area));
    ImGui::SetNextWindowSize({static_cast<float>(area.width), static_cast<float>(area.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, colours::backdrop);
    ImGui::Begin("##pictures", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse);
    const State& state = moment.state;
    const auto placed = placedPanes(state.layout, area, static_cast<double>(ui.px(2)),
                                    state.divider, state.flipped);
    for (const PlacedPane& pane : placed)
        drawPicture(moment, pane);
    if (!moment.drawn)
        centred(ui, area,
                moment.status.loading ? "Opening " + nameOf(state.scene) : "No picture yet",
                moment.status.loading ? moment.status.what : "Choose a scene, or drop a glTF file");
    if (state.panels && moment.drawn)
        legend(moment);
    if (state.layout == Layout::split && moment.drawn)
        dragDivider(moment);
    ImGui::SetCursorScreenPos(lowOf(area));
    ImGui::InvisibleButton("##hand",
                           {static_cast<float>(area.width), static_cast<float>(area.height)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    ui.note("pictures");
    hand.overPicture = ImGui::IsItemHovered();
    if (ImGui::IsItemActive())
        dragCamera(moment, hand);
    if (hand.overPicture || ImGui::IsItemActive())
        turnWheel(moment, placed);
    if (moment.drawn && hand.overPicture)
        hand.pixel =
            pixelAt(placed, state.magnification, moment.drawn->wanted.width,
                    moment.drawn->wanted.height, static_cast<double>(ImGui::GetIO().MousePos.x),
                    static_cast<double>(ImGui::GetIO().MousePos.y));
    if (state.panels && moment.drawn) {
        for (const PlacedPane& pane : placed)
            if (pane.pane >= 0)
                caption(moment, pane, state.layout == Layout::split && pane.pane == 1);
    }
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    return hand;
}

} // namespace obscura
