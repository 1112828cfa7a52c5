#include "matching/match_sheet.h"

#include "image/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace obscura {

namespace {

// Pixels.
constexpr int margin = 24, gap = 8, caption = 28, header = 84, widest = 480, tallest = 960;
constexpr int columns = 4, titleWidth = 220, captionWidth = 1400; // that words need
constexpr float fullColour = 0.25f;

// Of thumbnails that keep the views' shape and are never enlarged.
struct Size {
    int width, height;
};

Size thumbnailOf(const Image& reference) {
    const double scale =
        std::min({1.0, 1.0 * widest / reference.width, 1.0 * tallest / reference.height});
    return {std::max(static_cast<int>(reference.width * scale), 1),
            std::max(static_cast<int>(reference.height * scale), 1)};
}

Image8 sheetOf(const std::string& title, const Image& reference,
               std::span<const MatchPictures> techniques) {
    const auto [width, height] = thumbnailOf(reference);
    const int rowHeight = caption + height + gap;
    const auto column = [pitch = std::max(width, titleWidth) + gap](int i) {
        return margin + i * pitch;
    };
    Canvas page(std::max(column(columns) - gap + margin, captionWidth),
                header + margin + static_cast<int>(techniques.size()) * rowHeight);
    page.text(margin, margin, "<b>" + escaped(title) + "</b>", 20);
    const char* titles[columns] = {"reference", "raw", "matched",
                                   "too dark (red), too light (blue)"};
    for (int i = 0; i < columns; ++i)
        page.text(column(i), margin + 34, titles[i], 14);
    int top = header;
    for (const MatchPictures& technique : techniques) {
        page.text(margin, top + 4, escaped(technique.title), 14);
        int at = 0;
        for (const Image8& image : {grey(reference), grey(technique.raw), grey(technique.matched),
                                    signedError(technique.matched, reference, fullColour)}) {
            page.image(column(at), top + caption, shrunk(image, width, height));
            page.frame(column(at++), top + caption, width, height);
        }
        top += rowHeight;
    }
    return page.finish();
}

} // namespace

std::vector<Image8> matchSheet(const std::string& title, const Image& reference,
                               const std::vector<MatchPictures>& techniques) {
    const int rowHeight = caption + thumbnailOf(reference).height + gap;
    const std::vector<PageRows> pages = pagesOf(techniques.size(), rowHeight, header + margin);
    std::vector<Image8> result;
    for (std::size_t i = 0; i < pages.size(); ++i)
        result.push_back(
            sheetOf(pageTitle(title, i, pages.size()), reference,
                    std::span(techniques).subspan(pages[i].first, pages[i].last - pages[i].first)));
    return result;
}

} // namespace obscura
