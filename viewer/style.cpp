#include "viewer/style.h"

#include "base/error.h"

#include <imgui_freetype.h>

#include <cmath>
#include <filesystem>

namespace obscura {

namespace {

ImFont* font(const char* file, float pixels) {
    // Letters of European names, Greek and Cyrillic; punctuation, sub- and superscripts; arrows,
    // mathematics, shapes and symbols.
    static const ImWchar ranges[] = {0x20,   0x17F,  0x370,  0x52F,  0x2010, 0x209F, 0x2190, 0x22FF,
                                     0x2300, 0x23FF, 0x25A0, 0x26FF, 0x2700, 0x27BF, 0};
    const std::filesystem::path path =
        std::filesystem::path("/usr/share/fonts/truetype/dejavu") / file;
    if (!std::filesystem::exists(path))
        throw Error("expected the font " + path.string() +
                    ", found no such file; apt install fonts-dejavu-core");
    ImFontConfig config;
    config.OversampleH = config.OversampleV = 1;
    config.PixelSnapH = true;
    return ImGui::GetIO().Fonts->AddFontFromFileTTF(path.c_str(), pixels, &config, ranges);
}

void setColours(ImVec4* table) {
    const auto set = [table](int which, ImU32 colour) {
        table[which] = ImGui::ColorConvertU32ToFloat4(colour);
    };
    for (const auto& [which, colour] : {std::pair{ImGuiCol_Text, colours::text},
                                        {ImGuiCol_TextDisabled, colours::faint},
                                        {ImGuiCol_WindowBg, colours::panel},
                                        {ImGuiCol_ChildBg, IM_COL32(0, 0, 0, 0)},
                                        {ImGuiCol_PopupBg, colours::popup},
                                        {ImGuiCol_Border, colours::line},
                                        {ImGuiCol_FrameBg, colours::field},
                                        {ImGuiCol_FrameBgHovered, colours::fieldHovered},
                                        {ImGuiCol_FrameBgActive, colours::fieldHeld},
                                        {ImGuiCol_Button, colours::field},
                                        {ImGuiCol_ButtonHovered, colours::fieldHovered},
                                        {ImGuiCol_ButtonActive, colours::fieldHeld},
                                        {ImGuiCol_Header, colours::accentDim},
                                        {ImGuiCol_HeaderHovered, colours::fieldHovered},
                                        {ImGuiCol_HeaderActive, colours::fieldHeld},
                                        {ImGuiCol_Separator, colours::line},
                                        {ImGuiCol_ScrollbarBg, IM_COL32(0, 0, 0, 0)},
                                        {ImGuiCol_ScrollbarGrab, colours::field},
                                        {ImGuiCol_ScrollbarGrabHovered, colours::fieldHovered},
                                        {ImGuiCol_ScrollbarGrabActive, colours::fieldHeld},
                                        {ImGuiCol_TextSelectedBg, colours::accentDim},
                                        {ImGuiCol_ModalWindowDimBg, IM_COL32(0, 0, 0, 140)},
                                        {ImGuiCol_NavHighlight, colours::accent}})
        set(which, colour);
}

} // namespace

ImU32 faded(ImU32 colour, float share) {
    ImVec4 value = ImGui::ColorConvertU32ToFloat4(colour);
    value.w *= share;
    return ImGui::ColorConvertFloat4ToU32(value);
}

Theme makeTheme(float scale) {
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    io.Fonts->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    Theme theme;
    theme.scale = scale;
    // Whole pixels, or every second line of a text would lie between two.
    theme.text = font("DejaVuSans.ttf", std::round(13.5F * scale));
    theme.small = font("DejaVuSans.ttf", std::round(11.5F * scale));
    theme.bold = font("DejaVuSans-Bold.ttf", std::round(13.5F * scale));
    theme.mono = font("DejaVuSansMono.ttf", std::round(11.5F * scale));
    theme.title = font("DejaVuSans.ttf", std::round(20 * scale));

    ImGuiStyle style;
    style.WindowPadding = {12, 10};
    style.FramePadding = {9, 5};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.ScrollbarSize = 10;
    style.ScrollbarRounding = 5;
    style.FrameRounding = 5;
    style.PopupRounding = 7;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.WindowMinSize = {8, 8};
    style.ScaleAllSizes(scale);
    style.AntiAliasedLines = style.AntiAliasedFill = true;
    setColours(static_cast<ImVec4*>(style.Colors));
    ImGui::GetStyle() = style;
    return theme;
}

} // namespace obscura
