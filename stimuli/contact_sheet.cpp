#include "stimuli/contact_sheet.h"

#include "image/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace obscura {

namespace {

// Pixels. Thumbnails keep the stimuli's shape.
constexpr int margin = 24, gap = 8, caption = 40, header = 84, columns = 5;
constexpr int widest = 384, tallest = 768;

Image8 difference(const Image8& a, const Image8& b) {
    Image8 result{a.width, a.height, a.channels, {}};
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        result.pixels.push_back(
            static_cast<std::uint8_t>(std::min(std::abs(a.pixels[i] - b.pixels[i]) * 4, 255)));
    return result;
}

struct Size {
    int width, height;
};

Size thumbnailOf(const Manifest& manifest) {
    const double scale = std::min(1.0 * widest / manifest.width, 1.0 * tallest / manifest.height);
    return {std::max(static_cast<int>(manifest.width * scale), 1),
            std::max(static_cast<int>(manifest.height * scale), 1)};
}

std::string captionOf(const PairRecord& pair) {
    return fmt::format("<b>{}</b>   level {}, scene {}, radius {:g} m, mean occlusion: {} {:.3f}, "
                       "{} {:.3f}",
                       escaped(pair.condition), escaped(pair.level), escaped(pair.view),
                       pair.radius, escaped(pair.a.name), pair.a.meanOcclusion,
                       escaped(pair.b.name), pair.b.meanOcclusion);
}

Image8 sheetOf(const Manifest& manifest, const std::string& title, const PageRows& rows) {
    const auto [width, height] = thumbnailOf(manifest);
    const int rowHeight = caption + height + gap;
    Canvas page(2 * margin + columns * (widest + gap) - gap,
                header + margin + static_cast<int>(rows.last - rows.first) * rowHeight);
    const auto column = [](int i) { return margin + i * (widest + gap); };
    page.text(margin, margin, fmt::format("<b>{}</b>", escaped(title)), 22);
    const char* titles[columns] = {"image a", "image b", "visibility a", "visibility b",
                                   "|a − b| × 4"};
    for (int i = 0; i < columns; ++i)
        page.text(column(i), margin + 36, titles[i], 14);
    int top = header;
    for (std::size_t i = rows.first; i < rows.last; ++i, top += rowHeight) {
        const PairRecord& pair = manifest.pairs[i];
        page.text(margin, top + 14, captionOf(pair), 14);
        const auto load = [&](const FileRecord& file) {
            return readImage8(manifest.folder / file.path, 3);
        };
        const Image8 a = load(pair.a.image), b = load(pair.b.image);
        int at = 0;
        for (const Image8& image :
             {a, b, load(pair.a.layers.at("ao")), load(pair.b.layers.at("ao")), difference(a, b)}) {
            page.image(column(at), top + caption, shrunk(image, width, height));
            page.frame(column(at++), top + caption, width, height);
        }
    }
    return page.finish();
}

} // namespace

std::vector<Image8> contactSheets(const Manifest& manifest) {
    const std::vector<PageRows> pages = pagesOf(
        manifest.pairs.size(), caption + thumbnailOf(manifest).height + gap, header + margin);
    std::vector<Image8> sheets;
    for (std::size_t i = 0; i < pages.size(); ++i)
        sheets.push_back(sheetOf(manifest, pageTitle(manifest.title, i, pages.size()), pages[i]));
    return sheets;
}

} // namespace obscura
