#include "experiment/text.h"

#include "base/error.h"
#include "experiment/typesetter.h"
#include "image/canvas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

namespace obscura {

namespace {

using LayoutIter = std::unique_ptr<PangoLayoutIter, Call<pango_layout_iter_free>>;
using FontOptions = std::unique_ptr<cairo_font_options_t, Call<cairo_font_options_destroy>>;

struct PlacedPage {
    double bottom = 0;
    std::vector<Box> options, pictures;
};

void placePart(Setter& setter, const Page::Part& part, std::vector<Box>& options) {
    setter.title(part.label, 1, part.focus);
    setter.gap(part.label.empty() ? 0 : 0.5);
    if (part.field)
        options.push_back(setter.field(*part.field));
    if (part.slider)
        options.push_back(setter.slider(*part.slider));
    if (!part.options.empty()) {
        const std::vector<Box> boxes = setter.options(part.options, part.ofImages);
        options.insert(options.end(), boxes.begin(), boxes.end());
    }
}

// `top` is where the content begins, below the warning.
PlacedPage place(Setter& setter, const Page& page, double top) {
    PlacedPage placed;
    setter.y = top;
    if (page.pictures.count > 0) {
        placed.pictures = setter.pictures(page.pictures);
        setter.gap(0.4);
    }
    setter.title(page.heading, 1.5, true);
    setter.gap(page.heading.empty() ? 0 : 0.9);
    setter.facts(page.facts);
    setter.gap(page.facts.empty() ? 0 : 0.9);
    setter.paragraph(page.text, 1);
    if (page.field) {
        setter.gap(1);
        setter.field(*page.field);
    }
    for (const Page::Part& part : page.parts) {
        setter.gap(&part == &page.parts.front() && page.text.empty() ? 0 : 1);
        placePart(setter, part, placed.options);
    }
    if (!page.note.empty()) {
        setter.gap(0.8);
        setter.paragraph(page.note, 0.8);
    }
    placed.bottom = setter.y;
    if (!page.options.empty()) {
        setter.gap(page.pictures.count > 0 ? 0.7 : 1.6);
        const std::vector<Box> boxes =
            page.listed ? setter.list(page.options) : setter.options(page.options, page.ofImages);
        placed.options.insert(placed.options.end(), boxes.begin(), boxes.end());
        placed.bottom = setter.y;
    }
    return placed;
}

// Draws the page, or nothing when it does not fit with type of this size.
std::optional<PlacedPage> trySize(cairo_t* cairo, const Page& page, const Palette& palette,
                                  int width, int height, double em, bool breaksWords) {
    Setter setter(cairo, palette, width, em, page);
    setter.breaksWords = breaksWords;
    if (!page.warning.empty())
        setter.warning(page.warning);
    const double top = setter.y, margin = 1.2 * em;
    const double content = place(setter, page, 0).bottom;
    const double room = height - top - 2 * margin;
    if (content > room || setter.tooWide)
        return std::nullopt;

    setter.drawing = true;
    if (!page.warning.empty())
        setter.warning(page.warning);
    // A little above the middle looks like the middle.
    return place(setter, page, std::round(top + margin + 0.45 * (room - content)));
}

// What a page says, in short and on one line.
std::string opening(const Page& page) {
    std::string words = page.heading.empty() ? page.text : page.heading;
    if (words.empty() && !page.parts.empty())
        words = page.parts.front().label;
    std::replace_if(
        words.begin(), words.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return fmt::format("\"{:.60}\"", words);
}

std::string named(char32_t character) {
    if (character == PANGO_GLYPH_INVALID_INPUT)
        return "bytes that are not UTF-8";
    const std::string code = fmt::format("U+{:04X}", static_cast<unsigned>(character));
    char bytes[6];
    const int count = g_unichar_to_utf8(character, bytes);
    return g_unichar_isprint(character)
               ? fmt::format("{} ({})", std::string_view(bytes, static_cast<std::size_t>(count)),
                             code)
               : code;
}

bool isControl(char c) {
    return (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t') ||
           c == 0x7f;
}

} // namespace

DrawnPage drawPage(const Page& page, int width, int height, int grey) {
    const Palette palette = paletteFor(grey);
    const Canvas canvas(width, height, palette.paper);
    const FontOptions fontOptions(cairo_font_options_create());
    cairo_font_options_set_antialias(fontOptions.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(fontOptions.get(), CAIRO_HINT_STYLE_SLIGHT);
    cairo_set_font_options(canvas.cairo(), fontOptions.get());

    const double largest = std::max(smallestType, std::min(height / 27.0, width / 40.0));
    for (const bool breaksWords : {false, true}) // sooner small type than broken words
        for (int percent = 100; percent >= 60; percent -= 5) {
            const double em = std::max(smallestType, std::round(largest * percent / 100));
            if (auto placed =
                    trySize(canvas.cairo(), page, palette, width, height, em, breaksWords))
                return {canvas.finish(), std::move(placed->options), std::move(placed->pictures)};
        }
    if (const Page::Pictures& pictures = page.pictures; pictures.count > 0)
        throw Error(fmt::format(
            "{} images of {}x{} pixels and what is asked beside them do not fit "
            "on a screen of {}x{}, and images are never scaled: {}; choose a "
            "larger monitor (--monitor), smaller images or shorter texts",
            pictures.count, pictures.width, pictures.height, width, height, opening(page)));
    throw Error(fmt::format("a text is too long for a screen of {}x{} pixels, even in small type: "
                            "{}; shorten it in the protocol, or take a larger screen",
                            width, height, opening(page)));
}

// Where a font lacks a character, Pango's glyph is the character itself with a flag.
std::vector<std::string> unshowable(const std::string& text) {
    const Canvas canvas(1, 1);
    const Layout layout = layOut(canvas.cairo(), text, 2 * smallestType, false);
    std::set<char32_t> missing;
    for (const char c : text)
        if (isControl(c))
            missing.insert(static_cast<char32_t>(c));
    const LayoutIter iter(pango_layout_get_iter(layout.get()));
    do {
        const PangoLayoutRun* run = pango_layout_iter_get_run_readonly(iter.get());
        for (int i = 0; run && i < run->glyphs->num_glyphs; ++i)
            if (const PangoGlyph glyph = run->glyphs->glyphs[i].glyph;
                glyph & PANGO_GLYPH_UNKNOWN_FLAG)
                missing.insert(
                    glyph == PANGO_GLYPH_INVALID_INPUT ? glyph : glyph & ~PANGO_GLYPH_UNKNOWN_FLAG);
    } while (pango_layout_iter_next_run(iter.get()));
    std::vector<std::string> names;
    std::transform(missing.begin(), missing.end(), std::back_inserter(names), named);
    return names;
}

} // namespace obscura
