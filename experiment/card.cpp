#include "experiment/card.h"

#include "base/error.h"
#include "experiment/easel.h"
#include "experiment/page.h"
#include "experiment/screen_file.h"
#include "experiment/text.h"
#include "image/canvas.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace obscura {

namespace {

constexpr int grey = 128, light = 230;
constexpr double usualPixelsPerMm = 96 / 25.4;

int heightOf(int width) {
    return static_cast<int>(std::lround(width * cardHeightMm / cardWidthMm));
}

// Half of the screen's height: of any screen that is 11 cm high or more, that is enough for a card.
int widestOn(const Easel& easel) {
    return std::min(static_cast<int>(easel.height() / 2 * cardWidthMm / cardHeightMm),
                    easel.width() - 16);
}

Image8 rectangle(int width) {
    const int height = heightOf(width);
    Image8 image{width, height, 3, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool edge = std::min({x, y, width - 1 - x, height - 1 - y}) < 2;
            image.pixels.insert(image.pixels.end(), 3, edge ? 0 : light);
        }
    return image;
}

Page pageOf(const Easel& easel, int width) {
    const gl::Monitor& monitor = easel.monitor();
    Page page;
    page.pictures = {1, widestOn(easel), heightOf(widestOn(easel)), {}};
    page.heading = "How large is a pixel?";
    page.text =
        "Hold a bank card to the screen, its corner in that of the white rectangle. Make the "
        "rectangle as large: Left and Right change it by a pixel, Up and Down by ten; or drag "
        "its corner with the mouse.";
    page.facts = {
        {"Now", fmt::format("{} pixels, {:.3f} per mm", width, width / cardWidthMm)},
        {"Reported", monitor.widthMm > 0
                         ? fmt::format("{:.3f} per mm ({}x{} mm), not to be trusted",
                                       monitor.width / static_cast<double>(monitor.widthMm),
                                       monitor.widthMm, monitor.heightMm)
                         : "nothing"}};
    page.options = {{"Enter", "Keep"}, {"Escape", "Leave"}};
    return page;
}

// Its upper left corner, and the words below, stay where they are while it grows.
Box show(Easel& easel, int width) {
    const DrawnPage page = drawPage(pageOf(easel, width), easel.width(), easel.height(), grey);
    const Box room = page.pictures.front();
    easel.show({{page.image, 0, 0}, {rectangle(width), room.x, room.y}}, grey,
               fmt::format("card, {} pixels wide", width));
    return room;
}

// By how much a key changes the width.
int stepOf(gl::Key key) {
    switch (key) {
    case gl::Key::left:
        return -1;
    case gl::Key::right:
        return 1;
    case gl::Key::down:
        return -10;
    case gl::Key::up:
        return 10;
    default:
        return 0;
    }
}

// As large as the card, by the person's word; nothing for Escape.
std::optional<int> adjusted(Easel& easel) {
    constexpr int narrowest = 60;
    const int widest = std::max(narrowest, widestOn(easel));
    int width = std::clamp(static_cast<int>(usualPixelsPerMm * cardWidthMm), narrowest, widest);
    for (;;) {
        const Box room = show(easel, width);
        for (const gl::Input& input : easel.inputs()) {
            const bool press = input.kind == gl::Input::Kind::press;
            if (press && input.key == gl::Key::escape)
                return std::nullopt;
            if (press && (input.key == gl::Key::enter || input.key == gl::Key::keypadEnter))
                return width;
            if (press)
                width += stepOf(input.key);
            else if (input.kind == gl::Input::Kind::drag)
                width = input.x - room.x;
            width = std::clamp(width, narrowest, widest);
        }
    }
}

} // namespace

bool measureCard(const gl::WindowOptions& window, const std::filesystem::path& data) {
    Easel easel(window);
    const std::optional<int> width = adjusted(easel);
    if (!width)
        return false;
    const double pixelsPerMm = *width / cardWidthMm;
    const std::filesystem::path file = screenFile(data, easel.monitor());
    keepMeasured(file, easel.monitor(), "card", {{"pixels_per_mm", pixelsPerMm}});
    fmt::print("{:.4f} pixels per mm: the screen shows {:.0f} x {:.0f} mm; kept in {}\n",
               pixelsPerMm, easel.monitor().width / pixelsPerMm,
               easel.monitor().height / pixelsPerMm, file.string());
    return true;
}

} // namespace obscura
