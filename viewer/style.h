#pragma once

#include <imgui.h>

#include <array>

namespace obscura {

// How the viewer looks: neutral greys, so that nothing beside a picture tints what is seen of it,
// one accent, and a colour for each pane (after Okabe and Ito 2008, told apart by the
// colour-blind).
namespace colours {
constexpr ImU32 backdrop = IM_COL32(22, 22, 23, 255);
constexpr ImU32 panel = IM_COL32(33, 33, 35, 255);
constexpr ImU32 popup = IM_COL32(41, 41, 44, 252);
constexpr ImU32 field = IM_COL32(49, 49, 53, 255);
constexpr ImU32 fieldHovered = IM_COL32(60, 60, 65, 255);
constexpr ImU32 fieldHeld = IM_COL32(72, 72, 78, 255);
constexpr ImU32 line = IM_COL32(54, 54, 58, 255);
constexpr ImU32 text = IM_COL32(230, 230, 232, 255);
constexpr ImU32 muted = IM_COL32(163, 163, 170, 255);
constexpr ImU32 faint = IM_COL32(120, 120, 127, 255);
constexpr ImU32 accent = IM_COL32(88, 157, 218, 255);
constexpr ImU32 accentDim = IM_COL32(58, 98, 135, 255);
constexpr ImU32 warning = IM_COL32(226, 172, 84, 255);
constexpr ImU32 danger = IM_COL32(228, 112, 102, 255);
constexpr std::array<ImU32, 4> panes{IM_COL32(232, 170, 74, 255), IM_COL32(92, 180, 236, 255),
                                     IM_COL32(80, 188, 148, 255), IM_COL32(214, 134, 182, 255)};
} // namespace colours

// The same colour, that share as opaque.
ImU32 faded(ImU32 colour, float share);

struct Theme {
    float scale = 1; // of everything; 1 is 100 %
    ImFont *text = nullptr, *small = nullptr, *bold = nullptr, *title = nullptr, *mono = nullptr;
};

// Sets the current ImGui context's style and fonts (DejaVu Sans) for a scale. An Error where the
// fonts are not installed.
Theme makeTheme(float scale);

} // namespace obscura
