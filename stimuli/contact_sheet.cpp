#include "stimuli/contact_sheet.h"

#include "stimuli/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace obscura {

namespace {

// Pixels. Thumbnails keep the stimuli's shape.
constexpr int margin = 24, gap = 8, caption = 40, header = 84, thumbnailWidth = 384, columns = 5;

Image8 difference(const Image8& a, const Image8& b) {
    Image8 result{a.width, a.height, a.channels, {}};
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        result.pixels.push_back(
            static_cast<std::uint8_t>(std::min(std::abs(a.pixels[i] - b.pixels[i]) * 4, 255)));
    return result;
}

} // namespace

Image8 contactSheet(const Manifest& manifest) {
    const int thumbnailHeight = thumbnailWidth * manifest.height / manifest.width;
    const int rowHeight = caption + thumbnailHeight + gap;
    const int pairs = static_cast<int>(manifest.pairs.size());
    Page page(2 * margin + columns * (thumbnailWidth + gap) - gap,
              header + margin + pairs * rowHeight);
    const auto column = [](int i) { return margin + i * (thumbnailWidth + gap); };
    page.text(margin, margin, fmt::format("<b>{}</b>", escaped(manifest.title)), 22);
    const char* titles[columns] = {"image a", "image b", "visibility a", "visibility b",
                                   "|a − b| × 4"};
    for (int i = 0; i < columns; ++i)
        page.text(column(i), margin + 36, titles[i], 14);

    for (int i = 0; i < pairs; ++i) {
        const PairRecord& pair = manifest.pairs[static_cast<std::size_t>(i)];
        const int top = header + i * rowHeight;
        page.text(margin, top + 14,
                  fmt::format("<b>{}</b>   level {}, scene {}, radius {:g} m, mean occlusion: {} "
                              "{:.3f}, {} {:.3f}",
                              escaped(pair.condition), escaped(pair.level), escaped(pair.view),
                              pair.radius, escaped(pair.a.name), pair.a.meanOcclusion,
                              escaped(pair.b.name), pair.b.meanOcclusion),
                  14);
        const auto load = [&](const FileRecord& file) {
            return readImage8(manifest.folder / file.path, 3);
        };
        const Image8 a = load(pair.a.image), b = load(pair.b.image);
        int at = 0;
        for (const Image8& image :
             {a, b, load(pair.a.layers.at("ao")), load(pair.b.layers.at("ao")), difference(a, b)}) {
            page.image(column(at), top + caption, shrunk(image, thumbnailWidth, thumbnailHeight));
            page.frame(column(at++), top + caption, thumbnailWidth, thumbnailHeight);
        }
    }
    return page.finish();
}

} // namespace obscura
