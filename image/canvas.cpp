#include "image/canvas.h"

#include "base/error.h"

#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace obscura {

namespace {

struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
    void operator()(PangoLayout* layout) const { g_object_unref(layout); }
    void operator()(PangoFontDescription* font) const { pango_font_description_free(font); }
};
template <typename T>
using Held = std::unique_ptr<T, Destroy>;

constexpr int largestSurface = 32767; // across or down, of a Cairo surface
constexpr int tallestPage = 16000;

void check(cairo_status_t status, int width, int height) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw Error(fmt::format("a page of {} x {} pixels cannot be drawn: {}", width, height,
                                cairo_status_to_string(status)));
}

} // namespace

struct Canvas::Owned {
    Held<cairo_surface_t> surface;
    Held<cairo_t> cairo;
};

Canvas::Canvas(int width, int height, double grey) {
    if (std::min(width, height) < 1 || std::max(width, height) > largestSurface)
        throw Error(fmt::format("expected a page of 1 to {} pixels across and down, found {} x {}",
                                largestSurface, width, height));
    Held<cairo_surface_t> surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
    check(cairo_surface_status(surface.get()), width, height);
    Held<cairo_t> cairo(cairo_create(surface.get()));
    check(cairo_status(cairo.get()), width, height);
    cairo_set_source_rgb(cairo.get(), grey, grey, grey);
    cairo_paint(cairo.get());
    owned_.reset(new Owned{std::move(surface), std::move(cairo)});
}
Canvas::~Canvas() = default;

cairo_t* Canvas::cairo() const { return owned_->cairo.get(); }

void Canvas::text(int x, int y, const std::string& markup, int size) {
    const Held<PangoLayout> layout(pango_cairo_create_layout(owned_->cairo.get()));
    const Held<PangoFontDescription> font(
        pango_font_description_from_string(fmt::format("DejaVu Sans {}px", size).c_str()));
    pango_layout_set_font_description(layout.get(), font.get());
    pango_layout_set_markup(layout.get(), markup.c_str(), -1);
    cairo_set_source_rgb(owned_->cairo.get(), 0.1, 0.1, 0.1);
    cairo_move_to(owned_->cairo.get(), x, y);
    pango_cairo_show_layout(owned_->cairo.get(), layout.get());
}

void Canvas::image(int x, int y, const Image8& image) {
    assert(x >= 0 && x + image.width <= cairo_image_surface_get_width(owned_->surface.get()));
    assert(y >= 0 && y + image.height <= cairo_image_surface_get_height(owned_->surface.get()));
    cairo_surface_flush(owned_->surface.get());
    unsigned char* data = cairo_image_surface_get_data(owned_->surface.get());
    const int stride = cairo_image_surface_get_stride(owned_->surface.get());
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            unsigned char* to = data + (y + row) * stride + (x + column) * 4;
            const std::uint8_t* from =
                image.pixels.data() + (std::ptrdiff_t{row} * image.width + column) * 3;
            to[0] = from[2]; // little-endian xRGB
            to[1] = from[1];
            to[2] = from[0];
        }
    cairo_surface_mark_dirty(owned_->surface.get());
}

void Canvas::frame(int x, int y, int width, int height) {
    cairo_set_source_rgb(owned_->cairo.get(), 0.7, 0.7, 0.7);
    cairo_set_line_width(owned_->cairo.get(), 1);
    cairo_rectangle(owned_->cairo.get(), x - 0.5, y - 0.5, width + 1, height + 1);
    cairo_stroke(owned_->cairo.get());
}

Image8 Canvas::finish() const {
    cairo_surface_flush(owned_->surface.get());
    Image8 page{cairo_image_surface_get_width(owned_->surface.get()),
                cairo_image_surface_get_height(owned_->surface.get()),
                3,
                {}};
    check(cairo_status(owned_->cairo.get()), page.width, page.height);
    check(cairo_surface_status(owned_->surface.get()), page.width, page.height);
    const unsigned char* data = cairo_image_surface_get_data(owned_->surface.get());
    const int stride = cairo_image_surface_get_stride(owned_->surface.get());
    page.pixels.reserve(static_cast<std::size_t>(page.width) *
                        static_cast<std::size_t>(page.height) * 3);
    for (int row = 0; row < page.height; ++row)
        for (int column = 0; column < page.width; ++column)
            for (const int byte : {2, 1, 0})
                page.pixels.push_back(data[row * stride + column * 4 + byte]);
    return page;
}

std::vector<PageRows> pagesOf(std::size_t rows, int rowHeight, int headerHeight) {
    const auto most = static_cast<std::size_t>(
        std::max((tallestPage - headerHeight) / std::max(rowHeight, 1), 1));
    const std::size_t pages = std::max<std::size_t>((rows + most - 1) / most, 1);
    std::vector<PageRows> result;
    for (std::size_t page = 0; page < pages; ++page)
        result.push_back({rows * page / pages, rows * (page + 1) / pages});
    return result;
}

std::string pageName(const std::string& stem, std::size_t page, std::size_t pages) {
    return pages == 1 ? stem + ".png" : fmt::format("{}-{}.png", stem, page + 1);
}

std::string pageTitle(const std::string& title, std::size_t page, std::size_t pages) {
    return pages == 1 ? title : fmt::format("{} ({} of {})", title, page + 1, pages);
}

Image8 grey(const Image& visibility) {
    const Image8 code = quantised(visibility);
    Image8 result{code.width, code.height, 3, {}};
    for (const std::uint8_t value : code.pixels)
        result.pixels.insert(result.pixels.end(), 3, value);
    return result;
}

Image8 signedError(const Image& image, const Image& reference, float full) {
    Image8 result{image.width, image.height, 3, {}};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float d = std::clamp((image.pixels[i] - reference.pixels[i]) / full, -1.0f, 1.0f);
        const auto code = [](float value) {
            return static_cast<std::uint8_t>(std::lround(value * 255));
        };
        const std::uint8_t fading = code(1 - std::abs(d));
        result.pixels.insert(result.pixels.end(),
                             {d > 0 ? fading : code(1), fading, d < 0 ? fading : code(1)});
    }
    return result;
}

Image8 magma(const Image& values, float full) {
    constexpr std::array<std::array<float, 3>, 9> colours{{{0, 0, 4},
                                                           {28, 16, 68},
                                                           {79, 18, 123},
                                                           {129, 37, 129},
                                                           {181, 54, 122},
                                                           {229, 80, 100},
                                                           {251, 135, 97},
                                                           {254, 194, 135},
                                                           {252, 253, 191}}};
    Image8 result{values.width, values.height, 3, {}};
    for (const float value : values.pixels) {
        const float at = std::clamp(value / full, 0.0F, 1.0F) * (colours.size() - 1);
        const auto below = std::min(static_cast<std::size_t>(at), colours.size() - 2);
        const float share = at - static_cast<float>(below);
        for (std::size_t c = 0; c < 3; ++c)
            result.pixels.push_back(static_cast<std::uint8_t>(std::lround(
                colours[below][c] + share * (colours[below + 1][c] - colours[below][c]))));
    }
    return result;
}

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
                        sum +=
                            from.pixels
                                .data()[(std::ptrdiff_t{v} * from.width + u) * from.channels + c];
                to.pixels.push_back(static_cast<std::uint8_t>(sum / ((x1 - x0) * (y1 - y0))));
            }
    return to;
}

Image8 sideBySide(const Image8& left, const Image8& right) {
    constexpr int gap = 4;
    Canvas page(left.width + gap + right.width, left.height);
    page.image(0, 0, left);
    page.image(left.width + gap, 0, right);
    return page.finish();
}

} // namespace obscura
