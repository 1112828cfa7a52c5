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

// A row of the sheet: a condition, and from which of its images on. Of a pair it has both images,
// both visibilities and the difference; else images alone, as many as there are columns.
struct Row {
    const ConditionRecord* condition;
    std::size_t first = 0;
};

std::vector<Row> rowsOf(const Manifest& manifest) {
    std::vector<Row> rows;
    for (const ConditionRecord& condition : manifest.conditions)
        for (std::size_t first = 0; first < condition.images.size(); first += columns)
            rows.push_back({&condition, first});
    return rows;
}

std::string captionOf(const ConditionRecord& condition) {
    std::string text = fmt::format("<b>{}</b>   level {}, scene {}, radius {:g} m, mean occlusion:",
                                   escaped(condition.condition), escaped(condition.level),
                                   escaped(condition.view), condition.radius);
    for (const ImageRecord& image : condition.images)
        text += fmt::format(
            "{} {}{} {:.3f}", &image == &condition.images.front() ? "" : ",",
            condition.images.size() == 2 && condition.isPair() ? "" : escaped(image.role) + " ",
            escaped(image.name), image.meanOcclusion);
    return text;
}

std::vector<Image8> picturesOf(const Manifest& manifest, const Row& row) {
    const auto load = [&](const FileRecord& file) {
        return readImage8(manifest.folder / file.path, 3);
    };
    const std::deque<ImageRecord>& images = row.condition->images;
    std::vector<Image8> pictures;
    for (std::size_t i = row.first; i < std::min(images.size(), row.first + columns); ++i)
        pictures.push_back(load(images[i].image));
    if (images.size() == 2) {
        for (const ImageRecord& image : images)
            pictures.push_back(load(image.layers.at("ao")));
        pictures.push_back(difference(pictures[0], pictures[1]));
    }
    return pictures;
}

Image8 sheetOf(const Manifest& manifest, const std::string& title, std::span<const Row> rows) {
    const auto [width, height] = thumbnailOf(manifest);
    const int rowHeight = caption + height + gap;
    Canvas page(2 * margin + columns * (widest + gap) - gap,
                header + margin + static_cast<int>(rows.size()) * rowHeight);
    const auto column = [](int i) { return margin + i * (widest + gap); };
    page.text(margin, margin, fmt::format("<b>{}</b>", escaped(title)), 22);
    const char* titles[columns] = {"image a", "image b", "visibility a", "visibility b",
                                   "|a − b| × 4"};
    const bool pairs = std::all_of(rows.begin(), rows.end(), [](const Row& row) {
        return row.condition->images.size() == 2 && row.condition->isPair();
    });
    for (int i = 0; pairs && i < columns; ++i)
        page.text(column(i), margin + 36, titles[i], 14);
    int top = header;
    for (const Row& row : rows) {
        page.text(margin, top + 14, captionOf(*row.condition), 14);
        int at = 0;
        for (const Image8& image : picturesOf(manifest, row)) {
            page.image(column(at), top + caption, shrunk(image, width, height));
            page.frame(column(at++), top + caption, width, height);
        }
        top += rowHeight;
    }
    return page.finish();
}

} // namespace

std::vector<Image8> contactSheets(const Manifest& manifest) {
    const std::vector<Row> rows = rowsOf(manifest);
    const std::vector<PageRows> pages =
        pagesOf(rows.size(), caption + thumbnailOf(manifest).height + gap, header + margin);
    std::vector<Image8> sheets;
    for (std::size_t i = 0; i < pages.size(); ++i)
        sheets.push_back(
            sheetOf(manifest, pageTitle(manifest.title, i, pages.size()),
                    std::span(rows).subspan(pages[i].first, pages[i].last - pages[i].first)));
    return sheets;
}

} // namespace obscura
