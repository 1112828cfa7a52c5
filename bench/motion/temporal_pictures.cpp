#include "bench/motion/temporal_pictures.h"

#include "image/canvas.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

namespace {

constexpr int gap = 8, textHeight = 24;

// Enlarged so often that details can be seen, grey as colour.
Image8 shown(const Image& image, int factor) {
    const Image8 small = quantised(image);
    Image8 result{image.width * factor, image.height * factor, 3, {}};
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            const auto from = static_cast<std::size_t>(y / factor * image.width + x / factor);
            result.pixels.insert(result.pixels.end(), 3, small.pixels[from]);
        }
    return result;
}

} // namespace

Image amplified(Image change) {
    for (float& value : change.pixels)
        value *= changeGain;
    return change;
}

Image8 strip(std::span<const Image> images) {
    Image all{0, images[0].height, 1, {}};
    for (const Image& image : images)
        all.width += image.width;
    for (int y = 0; y < all.height; ++y)
        for (const Image& image : images) {
            const auto row = image.pixels.begin() + y * image.width;
            all.pixels.insert(all.pixels.end(), row, row + image.width);
        }
    return quantised(all);
}

Image8 animationFrame(std::span<const AnimatedRow> rows, const Image& truth) {
    const int factor = std::max(1, 400 / truth.width);
    const int width = truth.width * factor, height = truth.height * factor;
    Canvas page(3 * width + 4 * gap,
                static_cast<int>(rows.size()) * (height + textHeight + gap) + gap);
    for (int i = 0; const AnimatedRow& row : rows) {
        const int y = gap + i++ * (height + textHeight + gap);
        const std::string titles[] = {row.title, "ray traced",
                                      fmt::format("unreal change, × {}", changeGain)};
        const Image images[] = {row.visibility, truth, amplified(row.unreal)};
        for (int column = 0; column < 3; ++column) {
            const int x = gap + column * (width + gap);
            page.text(x, y, escaped(titles[column]), 15);
            page.image(x, y + textHeight, shown(images[column], factor));
        }
    }
    return page.finish();
}

} // namespace obscura
