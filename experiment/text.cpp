#include "experiment/text.h"

#include "base/error.h"
#include "image/canvas.h"

#include <fmt/format.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <set>

namespace obscura {

namespace {

template <auto function>
struct Call {
    template <typename T>
    void operator()(T* object) const {
        function(object);
    }
};
using Layout = std::unique_ptr<PangoLayout, Call<g_object_unref>>;
using Font = std::unique_ptr<PangoFontDescription, Call<pango_font_description_free>>;
using LayoutIter = std::unique_ptr<PangoLayoutIter, Call<pango_layout_iter_free>>;
using FontOptions = std::unique_ptr<cairo_font_options_t, Call<cairo_font_options_destroy>>;

constexpr const char* family = "DejaVu Sans, Noto Sans, Liberation Sans, Sans";
constexpr double lineSpacing = 1.18;
constexpr double measure = 34;     // line length in em: some 65 characters
constexpr double smallestType = 9; // pixels; letters of fewer cannot be told apart

Layout layOut(cairo_t* cairo, const std::string& text, double pixels, bool bold) {
    Layout layout(pango_cairo_create_layout(cairo));
    const Font font(pango_font_description_from_string(family));
    pango_font_description_set_absolute_size(font.get(), std::round(pixels) * PANGO_SCALE);
    pango_font_description_set_weight(font.get(), bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_layout_set_font_description(layout.get(), font.get());
    pango_layout_set_text(layout.get(), text.data(), static_cast<int>(text.size()));
    return layout;
}

// Shades of grey that go with the page's own, in [0, 1].
struct Palette {
    double paper, ink, card, edge;
};

// Black contrasts more than white where the paper is lighter than about code value 118.
Palette paletteFor(int grey) {
    const double paper = grey / 255.0;
    const double towardsInk = grey >= 118 ? -1 : 1;
    return {paper, grey >= 118 ? 0.04 : 0.96, std::clamp(paper - towardsInk * 0.1, 0.0, 1.0),
            std::clamp(paper + towardsInk * 0.2, 0.0, 1.0)};
}

// One attempt at a page with type of a given size: places things from top to bottom, either only
// to measure (nothing is drawn) or for good.
class Setter {
  public:
    Setter(cairo_t* cairo, const Palette& palette, int width, double em)
        : cairo_(cairo), palette_(palette), width_(width), em_(em) {}

    double y = 0;
    bool tooWide = false; // something does not fit between the sides

    void warning(const std::string& text);
    void paragraph(const std::string& text, double size, bool bold = false);
    void field(const std::string& typed);
    std::vector<Box> options(const std::vector<Page::Option>& options);
    void gap(double ems) { y += ems * em_; }

    bool drawing = false;

  private:
    // A text whose lines have been broken, and the box around all that is drawn of it, as seen from
    // the layout's own origin: of a text from right to left it begins far from there.
    struct Block {
        Layout layout;
        double x = 0, y = 0, width = 0, height = 0;
    };
    struct Card {
        Block key, label;
        double width = 0, height = 0;
    };

    Layout lay(const std::string& text, double size, bool bold, double wrapAt) const;
    static Block boxed(Layout layout);
    Block block(const std::string& text, double size, bool bold, double wrapAt) const;
    void ink(double grey) const { cairo_set_source_rgb(cairo_, grey, grey, grey); }
    void rounded(double x, double top, double width, double height, double radius) const;
    void put(const Block& block, double left, double top) const;
    Card card(const Page::Option& option, double widest) const;
    void drawCard(const Card& card, double x, double width) const;
    double column() const { return std::min(measure * em_, 0.86 * width_); }

    cairo_t* cairo_;
    const Palette& palette_;
    double width_, em_;
};

// A text stands at its layout's left or right side as its letters run, so the layout is made no
// wider than its widest line: then either side is the block's own.
void narrow(PangoLayout* layout) {
    const LayoutIter lines(pango_layout_get_iter(layout));
    int widest = 0;
    do {
        PangoRectangle logical;
        pango_layout_iter_get_line_extents(lines.get(), nullptr, &logical);
        widest = std::max(widest, logical.width);
    } while (pango_layout_iter_next_line(lines.get()));
    // A pixel more, so that rounding does not break a line anew.
    pango_layout_set_width(layout, std::min(pango_layout_get_width(layout), widest + PANGO_SCALE));
}

Layout Setter::lay(const std::string& text, double size, bool bold, double wrapAt) const {
    Layout layout = layOut(cairo_, text, size * em_, bold);
    pango_layout_set_width(layout.get(), static_cast<int>(std::max(wrapAt, em_)) * PANGO_SCALE);
    pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
    pango_layout_set_line_spacing(layout.get(), lineSpacing);
    return layout;
}

Setter::Block Setter::boxed(Layout layout) {
    PangoRectangle ink, logical;
    pango_layout_get_pixel_extents(layout.get(), &ink, &logical);
    const auto [left, right] =
        std::minmax({logical.x, logical.x + logical.width, ink.x, ink.x + ink.width});
    const auto [top, bottom] =
        std::minmax({logical.y, logical.y + logical.height, ink.y, ink.y + ink.height});
    return {std::move(layout), static_cast<double>(left), static_cast<double>(top),
            static_cast<double>(right - left), static_cast<double>(bottom - top)};
}

Setter::Block Setter::block(const std::string& text, double size, bool bold, double wrapAt) const {
    if (text.empty())
        return {};
    Layout layout = lay(text, size, bold, wrapAt);
    narrow(layout.get());
    return boxed(std::move(layout));
}

void Setter::rounded(double x, double top, double width, double height, double radius) const {
    constexpr double quarter = 1.5707963267948966;
    cairo_new_path(cairo_);
    cairo_arc(cairo_, x + width - radius, top + radius, radius, -quarter, 0);
    cairo_arc(cairo_, x + width - radius, top + height - radius, radius, 0, quarter);
    cairo_arc(cairo_, x + radius, top + height - radius, radius, quarter, 2 * quarter);
    cairo_arc(cairo_, x + radius, top + radius, radius, 2 * quarter, 3 * quarter);
    cairo_close_path(cairo_);
}

void Setter::put(const Block& block, double left, double top) const {
    if (!block.layout)
        return;
    cairo_move_to(cairo_, std::round(left - block.x), std::round(top - block.y));
    pango_cairo_show_layout(cairo_, block.layout.get());
}

// The only thing on a page that is meant to be seen from across the room.
void Setter::warning(const std::string& text) {
    Layout layout = lay(text, 0.8, true, 0.94 * width_);
    pango_layout_set_alignment(layout.get(), PANGO_ALIGN_CENTER);
    const Block band = boxed(std::move(layout));
    const double height = band.height + 0.8 * em_;
    if (drawing) {
        ink(palette_.ink);
        cairo_rectangle(cairo_, 0, 0, width_, height);
        cairo_fill(cairo_);
        ink(palette_.ink < 0.5 ? 1 : 0);
        put(band, (width_ - band.width) / 2, 0.4 * em_);
    }
    tooWide |= band.width > width_;
    y = height;
}

// Centred as a block, its lines flush with the side from which they are read: a short line stands
// over the options, a long text fills the column.
void Setter::paragraph(const std::string& text, double size, bool bold) {
    if (text.empty())
        return;
    const Block lines = block(text, size, bold, column());
    if (drawing) {
        ink(palette_.ink);
        put(lines, (width_ - lines.width) / 2, y);
    }
    tooWide |= lines.width > width_;
    y += lines.height;
}

// Of a text that is too long for the field, the end is shown.
void Setter::field(const std::string& typed) {
    const double fieldWidth = std::min(18 * em_, column()), height = 2.2 * em_;
    const double x = (width_ - fieldWidth) / 2;
    Layout layout = lay(typed + "\u2502", 1.1, false, fieldWidth - 1.2 * em_);
    pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
    pango_layout_set_ellipsize(layout.get(), PANGO_ELLIPSIZE_START);
    const Block line = boxed(std::move(layout));
    if (drawing) {
        rounded(x, y, fieldWidth, height, 0.3 * em_);
        ink(palette_.card);
        cairo_fill_preserve(cairo_);
        ink(palette_.edge);
        cairo_set_line_width(cairo_, 2);
        cairo_stroke(cairo_);
        ink(palette_.ink);
        put(line, x + 0.6 * em_, y + (height - line.height) / 2);
    }
    y += height;
}

// A key's cap, and beside it what the key says; together no wider than `widest`, if that can be.
Setter::Card Setter::card(const Page::Option& option, double widest) const {
    constexpr double around = 1.6, inCap = 1, beside = 0.8; // em
    Card card;
    card.key = block(option.key, 0.9, true, widest - (around + inCap) * em_);
    card.width = std::max(card.key.width, em_) + (inCap + around) * em_;
    if (!option.label.empty()) {
        card.label = block(option.label, 1, false, widest - card.width - beside * em_);
        card.width += card.label.width + beside * em_;
    }
    card.height = std::max(card.key.height, card.label.height) + 1.8 * em_;
    return card;
}

void Setter::drawCard(const Card& card, double x, double width) const {
    rounded(x, y, width, card.height, 0.4 * em_);
    ink(palette_.card);
    cairo_fill_preserve(cairo_);
    ink(palette_.edge);
    cairo_set_line_width(cairo_, 2);
    cairo_stroke(cairo_);

    const Block &key = card.key, &label = card.label;
    const double capWidth = std::max(key.width, em_) + em_;
    const double capHeight = key.height + 0.6 * em_;
    const double left = std::round(x + (width - card.width) / 2 + 0.8 * em_);
    const double middle = y + card.height / 2;
    ink(palette_.ink);
    put(key, left + (capWidth - key.width) / 2, middle - key.height / 2);
    if (!label.layout) // the card itself is the key
        return;
    rounded(left, middle - capHeight / 2, capWidth, capHeight, 0.25 * em_);
    cairo_stroke(cairo_);
    put(label, left + capWidth + 0.8 * em_, middle - label.height / 2);
}

// Side by side, of one size, centred: the first image's option is the left one, as its arrow key
// is, whichever way the words run.
std::vector<Box> Setter::options(const std::vector<Page::Option>& options) {
    const double space = 1.6 * em_, count = static_cast<double>(options.size());
    const double room = width_ - 2 * em_ - (count - 1) * space;
    std::vector<Card> cards;
    double width = 0, height = 0;
    for (const Page::Option& option : options) {
        cards.push_back(card(option, std::floor(room / count)));
        width = std::max(width, cards.back().width);
        height = std::max(height, cards.back().height);
    }
    tooWide |= count * width > room;
    double x = std::round((width_ - count * width - (count - 1) * space) / 2);
    std::vector<Box> boxes;
    for (Card& card : cards) {
        card.height = height;
        if (drawing)
            drawCard(card, x, width);
        boxes.push_back({static_cast<int>(x), static_cast<int>(y), static_cast<int>(width),
                         static_cast<int>(height)});
        x += width + space;
    }
    y += height;
    return boxes;
}

struct Placed {
    double bottom;
    std::vector<Box> options;
};

// `top` is where the content begins, below the warning.
Placed place(Setter& setter, const Page& page, double top) {
    setter.y = top;
    setter.paragraph(page.heading, 1.5, true);
    setter.gap(page.heading.empty() ? 0 : 0.9);
    setter.paragraph(page.text, 1);
    if (page.hasField) {
        setter.gap(1);
        setter.field(page.field);
    }
    if (!page.note.empty()) {
        setter.gap(0.8);
        setter.paragraph(page.note, 0.8);
    }
    Placed placed{setter.y, {}};
    if (!page.options.empty()) {
        setter.gap(1.6);
        placed.options = setter.options(page.options);
        placed.bottom = setter.y;
    }
    return placed;
}

// Draws the page, or nothing when it does not fit with type of this size.
std::optional<std::vector<Box>> trySize(cairo_t* cairo, const Page& page, const Palette& palette,
                                        int width, int height, double em) {
    Setter setter(cairo, palette, width, em);
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
    return place(setter, page, std::round(top + margin + 0.45 * (room - content))).options;
}

// What a page says, in short and on one line.
std::string opening(const Page& page) {
    std::string words = page.heading.empty() ? page.text : page.heading;
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
    for (int percent = 100; percent >= 60; percent -= 5) {
        const double em = std::max(smallestType, std::round(largest * percent / 100));
        if (auto options = trySize(canvas.cairo(), page, palette, width, height, em))
            return {canvas.finish(), std::move(*options)};
    }
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
