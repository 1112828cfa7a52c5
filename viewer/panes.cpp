#include "viewer/panes.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

std::pair<int, int> columnsAndRows(Layout layout) {
    return {layout == Layout::sideBySide || layout == Layout::grid ? 2 : 1,
            layout == Layout::grid ? 2 : 1};
}

// Whole pixels, so that a picture at scale 1 is copied pixel by pixel.
Box cell(Layout layout, const Box& area, double gap, int column, int row) {
    const auto [columns, rows] = columnsAndRows(layout);
    const double width = std::floor((area.width - gap * (columns - 1)) / columns);
    const double height = std::floor((area.height - gap * (rows - 1)) / rows);
    return {area.x + column * (width + gap), area.y + row * (height + gap), width, height};
}

double kept(double centre, double factor) {
    const double half = 0.5 / factor;
    return std::clamp(centre, half, 1 - half);
}

} // namespace

const std::array<std::string, 6>& layoutNames() {
    static const std::array<std::string, 6> names{"single", "split",   "side-by-side",
                                                  "grid",   "flicker", "difference"};
    return names;
}

int panesOf(Layout layout) {
    if (layout == Layout::single)
        return 1;
    return layout == Layout::grid ? 4 : 2;
}

std::vector<PlacedPane> placedPanes(Layout layout, const Box& area, double gap, double divider,
                                    bool flipped) {
    const Box whole = cell(layout, area, gap, 0, 0);
    switch (layout) {
    case Layout::single:
        return {{0, whole, whole}};
    case Layout::flicker:
        return {{flipped ? 1 : 0, whole, whole}};
    case Layout::difference:
        return {{-1, whole, whole}};
    case Layout::split: {
        const double left = std::round(whole.width * divider);
        return {{0, whole, {whole.x, whole.y, left, whole.height}},
                {1, whole, {whole.x + left, whole.y, whole.width - left, whole.height}}};
    }
    case Layout::sideBySide:
    case Layout::grid:
        break;
    }
    std::vector<PlacedPane> panes;
    for (int pane = 0; pane < panesOf(layout); ++pane) {
        const Box place = cell(layout, area, gap, pane % 2, pane / 2);
        panes.push_back({pane, place, place});
    }
    return panes;
}

std::pair<int, int> pictureSize(Layout layout, const Box& area, double gap, double renderScale) {
    const Box place = cell(layout, area, gap, 0, 0);
    const auto scaled = [&](double length) {
        return std::max(16, static_cast<int>(std::lround(length * renderScale)));
    };
    return {scaled(place.width), scaled(place.height)};
}

Box shownPart(const Magnification& magnification) {
    const double size = 1 / magnification.factor;
    return {magnification.x - size / 2, magnification.y - size / 2, size, size};
}

Magnification magnified(const Magnification& magnification, double by, double x, double y) {
    const Box before = shownPart(magnification);
    Magnification result;
    result.factor = std::clamp(magnification.factor * by, 1.0, 64.0);
    const double size = 1 / result.factor;
    result.x = kept(before.x + x * before.width + (0.5 - x) * size, result.factor);
    result.y = kept(before.y + y * before.height + (0.5 - y) * size, result.factor);
    return result;
}

Magnification shifted(const Magnification& magnification, double x, double y) {
    Magnification result = magnification;
    result.x = kept(magnification.x - x / magnification.factor, magnification.factor);
    result.y = kept(magnification.y - y / magnification.factor, magnification.factor);
    return result;
}

std::optional<PixelAt> pixelAt(const std::vector<PlacedPane>& panes,
                               const Magnification& magnification, int width, int height,
                               double screenX, double screenY) {
    const Box part = shownPart(magnification);
    for (const PlacedPane& pane : panes) {
        if (!pane.clip.contains(screenX, screenY))
            continue;
        const double u = part.x + (screenX - pane.place.x) / pane.place.width * part.width;
        const double v = part.y + (screenY - pane.place.y) / pane.place.height * part.height;
        return PixelAt{pane.pane, std::clamp(static_cast<int>(u * width), 0, width - 1),
                       std::clamp(static_cast<int>(v * height), 0, height - 1)};
    }
    return {};
}

} // namespace obscura
