#include "stimuli/contact_sheet.h"

#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

namespace obscura {

namespace {

// Pixels. Thumbnails keep the stimuli's shape.
constexpr int margin = 24, gap = 8, caption = 40, header = 84, thumbnailWidth = 384, columns = 5;

struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
    void operator()(PangoLayout* layout) const { g_object_unref(layout); }
    void operator()(PangoFontDescription* font) const { pango_font_description_free(font); }
};
template <typename T>
using Owned = std::unique_ptr<T, Destroy>;

class Page {
  public:
    Page(int width, int height)
        : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
          cairo_(cairo_create(surface_.get())) {
        cairo_set_source_rgb(cairo_.get(), 1, 1, 1);
        cairo_paint(cairo_.get());
    }

    void text(int x, int y, const std::string& markup, int points) {
        const Owned<PangoLayout> layout(pango_cairo_create_layout(cairo_.get()));
        const Owned<PangoFontDescription> font(
            pango_font_description_from_string(fmt::format("DejaVu Sans {}px", points).c_str()));
        pango_layout_set_font_description(layout.get(), font.get());
        pango_layout_set_markup(layout.get(), markup.c_str(), -1);
        cairo_set_source_rgb(cairo_.get(), 0.1, 0.1, 0.1);
        cairo_move_to(cairo_.get(), x, y);
        pango_cairo_show_layout(cairo_.get(), layout.get());
    }

    void image(int x, int y, const Image8& image) {
        cairo_surface_flush(surface_.get());
        unsigned char* data = cairo_image_surface_get_data(surface_.get());
        const int stride = cairo_image_surface_get_stride(surface_.get());
        for (int row = 0; row < image.height; ++row)
            for (int column = 0; column < image.width; ++column) {
                unsigned char* to = data + (y + row) * stride + (x + column) * 4;
                const std::uint8_t* from =
                    &image.pixels[static_cast<std::size_t>((row * image.width + column) * 3)];
                to[0] = from[2]; // little-endian xRGB
                to[1] = from[1];
                to[2] = from[0];
            }
        cairo_surface_mark_dirty(surface_.get());
    }

    // White visibility on white paper needs an edge.
    void frame(int x, int y, int width, int height) {
        cairo_set_source_rgb(cairo_.get(), 0.7, 0.7, 0.7);
        cairo_set_line_width(cairo_.get(), 1);
        cairo_rectangle(cairo_.get(), x - 0.5, y - 0.5, width + 1, height + 1);
        cairo_stroke(cairo_.get());
    }

    Image8 finish() const {
        cairo_surface_flush(surface_.get());
        Image8 page{cairo_image_surface_get_width(surface_.get()),
                    cairo_image_surface_get_height(surface_.get()),
                    3,
                    {}};
        const unsigned char* data = cairo_image_surface_get_data(surface_.get());
        const int stride = cairo_image_surface_get_stride(surface_.get());
        for (int row = 0; row < page.height; ++row)
            for (int column = 0; column < page.width; ++column)
                for (const int byte : {2, 1, 0})
                    page.pixels.push_back(data[row * stride + column * 4 + byte]);
        return page;
    }

  private:
    Owned<cairo_surface_t> surface_;
    Owned<cairo_t> cairo_;
};

// Box-filtered on code values: a thumbnail to recognise, not to measure.
Image8 shrunk(const Image8& from, int width, int height) {
    Image8 to{width, height, from.channels, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < from.channels; ++c) {
                const int x0 = x * from.width / width, y0 = y * from.height / height;
                const int x1 = std::max((x + 1) * from.width / width, x0 + 1);
                const int y1 = std::max((y + 1) * from.height / height, y0 + 1);
                int sum = 0;
                for (int v = y0; v < y1; ++v)
                    for (int u = x0; u < x1; ++u)
                        sum += from.pixels[static_cast<std::size_t>(
                            (v * from.width + u) * from.channels + c)];
                to.pixels.push_back(static_cast<std::uint8_t>(sum / ((x1 - x0) * (y1 - y0))));
            }
    return to;
}

Image8 difference(const Image8& a, const Image8& b) {
    Image8 result{a.width, a.height, a.channels, {}};
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        result.pixels.push_back(
            static_cast<std::uint8_t>(std::min(std::abs(a.pixels[i] - b.pixels[i]) * 4, 255)));
    return result;
}

std::string escaped(const std::string& text) {
    const std::unique_ptr<char, decltype(&g_free)> result(g_markup_escape_text(text.c_str(), -1),
                                                          &g_free);
    return result.get();
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
