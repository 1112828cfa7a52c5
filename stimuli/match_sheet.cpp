#include "stimuli/match_sheet.h"

#include "stimuli/page.h"

#include <algorithm>

namespace obscura {

namespace {

// Pixels. Thumbnails keep the views' shape and are never enlarged.
constexpr int margin = 24, gap = 8, caption = 28, header = 84, widest = 480, columns = 4;
constexpr float fullColour = 0.25f;

} // namespace

Image8 matchSheet(const std::string& title, const Image& reference,
                  const std::vector<MatchPictures>& techniques) {
    const int width = std::min(reference.width, widest);
    const int height = std::max(width * reference.height / reference.width, 1);
    const int rowHeight = caption + height + gap;
    const auto column = [&](int i) { return margin + i * (width + gap); };
    Page page(std::max(2 * margin + columns * (width + gap) - gap, 480),
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

} // namespace obscura
