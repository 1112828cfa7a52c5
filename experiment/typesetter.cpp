#include "experiment/typesetter.h"

#include "experiment/script.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace obscura {

namespace {

using Font = std::unique_ptr<PangoFontDescription, Call<pango_font_description_free>>;
using LayoutIter = std::unique_ptr<PangoLayoutIter, Call<pango_layout_iter_free>>;

constexpr const char* family = "DejaVu Sans, Noto Sans, Liberation Sans, Sans";
constexpr double lineSpacing = 1.18;
constexpr double measure = 34; // line length in em: some 65 characters

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

// The languages that fonts know have no scripts in their tags: of Chinese, they have countries.
PangoLanguage* fontLanguage(const std::string& tag) {
    std::string lower = tag;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool country = lower.find("-tw") != lower.npos || lower.find("-hk") != lower.npos ||
                         lower.find("-mo") != lower.npos;
    if (lower == "zh" || (lower.starts_with("zh-hans") && !country))
        lower = "zh-cn";
    else if (lower.starts_with("zh-hant"))
        lower = lower.find("-hk") != lower.npos ? "zh-hk" : "zh-tw";
    return pango_language_from_string(lower.c_str());
}

} // namespace

Layout layOut(cairo_t* cairo, const std::string& text, double pixels, bool bold,
              const Script& script) {
    Layout layout(pango_cairo_create_layout(cairo));
    PangoContext* context = pango_layout_get_context(layout.get());
    if (!script.language.empty())
        pango_context_set_language(context, fontLanguage(script.language));
    if (script.direction) {
        pango_context_set_base_dir(context, *script.direction);
        pango_layout_set_auto_dir(layout.get(), FALSE); // nor does Pango then choose the side
        pango_layout_set_alignment(layout.get(), *script.direction == PANGO_DIRECTION_RTL
                                                     ? PANGO_ALIGN_RIGHT
                                                     : PANGO_ALIGN_LEFT);
    }
    const Font font(pango_font_description_from_string(family));
    pango_font_description_set_absolute_size(font.get(), std::round(pixels) * PANGO_SCALE);
    pango_font_description_set_weight(font.get(), bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_layout_set_font_description(layout.get(), font.get());
    pango_layout_set_text(layout.get(), text.data(), static_cast<int>(text.size()));
    return layout;
}

// Black contrasts more than white where the paper is lighter than about code value 118.
Palette paletteFor(int grey) {
    const double paper = grey / 255.0;
    const double towardsInk = grey >= 118 ? -1 : 1;
    return {paper, grey >= 118 ? 0.04 : 0.96, std::clamp(paper - towardsInk * 0.1, 0.0, 1.0),
            std::clamp(paper + towardsInk * 0.2, 0.0, 1.0)};
}

std::vector<Box> gridOf(const Page::Pictures& pictures, int width, int below) {
    constexpr int gap = 24;
    const int most = std::max((width + gap) / (pictures.width + gap), 1);
    const int rows = (pictures.count + most - 1) / most;
    std::vector<Box> boxes;
    for (int row = 0, done = 0; row < rows; ++row) { // rows as even as can be
        const int columns = (pictures.count - done + rows - row - 1) / (rows - row);
        const int left = (width - columns * pictures.width - (columns - 1) * gap) / 2;
        for (int column = 0; column < columns; ++column, ++done)
            boxes.push_back({left + column * (pictures.width + gap),
                             row * (pictures.height + std::max(below, gap)), pictures.width,
                             pictures.height});
    }
    return boxes;
}

double Setter::column(double size) const { return std::min(measure * size * em_, 0.86 * width_); }

Layout Setter::lay(const std::string& text, double size, bool bold, double wrapAt,
                   const Script& script) const {
    Layout layout = layOut(cairo_, text, size * em_, bold, script);
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

Setter::Block Setter::block(const std::string& text, double size, bool bold, double wrapAt,
                            const Script& script) const {
    if (text.empty())
        return {};
    Layout layout = lay(text, size, bold, wrapAt, script);
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

void Setter::centred(const std::string& text, double size, bool bold, PangoAlignment alignment) {
    if (text.empty())
        return;
    Layout layout = lay(text, size, bold, column(size));
    pango_layout_set_alignment(layout.get(), alignment);
    narrow(layout.get());
    const Block lines = boxed(std::move(layout));
    if (drawing) {
        ink(palette_.ink);
        put(lines, (width_ - lines.width) / 2, y);
    }
    tooWide |= lines.width > width_;
    y += lines.height;
}

// Centred as a block, its lines flush with the side from which they are read: a short line stands
// over the options, a long text fills the column.
void Setter::paragraph(const std::string& text, double size, bool bold) {
    centred(text, size, bold, mirrored_ ? PANGO_ALIGN_RIGHT : PANGO_ALIGN_LEFT);
}

void Setter::title(const std::string& text, double size, bool bold) {
    centred(text, size, bold, PANGO_ALIGN_CENTER);
}

void Setter::facts(const std::vector<Page::Fact>& facts) {
    constexpr double size = 0.75;
    const double length = std::min(1.4 * column(), 0.9 * width_);
    double names = 0, values = 0;
    for (const Page::Fact& fact : facts)
        names = std::max(names, block(fact.name, size, true, length / 2, {}).width);
    const double beside = names + 1.2 * em_;
    for (const Page::Fact& fact : facts)
        values = std::max(values, block(fact.value, size, false, length - beside, {}).width);
    const double x = (width_ - beside - values) / 2;
    for (const Page::Fact& fact : facts) {
        const Block name = block(fact.name, size, true, length / 2, {}),
                    value = block(fact.value, size, false, length - beside, {});
        if (drawing) {
            ink(palette_.ink);
            put(name, x, y);
            put(value, x + beside, y);
        }
        tooWide |= beside + value.width > length + 1;
        y += std::max(name.height, value.height) + 0.25 * em_;
    }
}

void Setter::fill(double shade, double edge, double line) const {
    ink(shade);
    cairo_fill_preserve(cairo_);
    ink(edge);
    cairo_set_line_width(cairo_, line);
    cairo_stroke(cairo_);
}

// Of a text that is too long for the field, the end is shown. What is typed runs as its own letters
// do, and stands at the side from which the page is read.
Box Setter::field(const Page::Field& field) {
    const double fieldWidth = std::min(18 * em_, column()), height = 2.2 * em_;
    const double x = (width_ - fieldWidth) / 2, top = y;
    Layout layout =
        lay(field.typed + (field.focus ? "\u2502" : ""), 1.1, false, fieldWidth - 1.2 * em_,
            {script_.language,
             runsFromRightToLeft(field.typed) ? PANGO_DIRECTION_RTL : PANGO_DIRECTION_LTR});
    pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
    pango_layout_set_ellipsize(layout.get(), PANGO_ELLIPSIZE_START);
    const Block line = boxed(std::move(layout));
    if (drawing) {
        rounded(x, y, fieldWidth, height, 0.3 * em_);
        fill(palette_.card, field.focus ? palette_.ink : palette_.edge, field.focus ? 3 : 2);
        ink(palette_.ink);
        put(line, mirrored_ ? x + fieldWidth - 0.6 * em_ - line.width : x + 0.6 * em_,
            y + (height - line.height) / 2);
    }
    y += height;
    return {static_cast<int>(x), static_cast<int>(top), static_cast<int>(fieldWidth),
            static_cast<int>(height)};
}

// A line with a knob, its value above, what its ends mean below. Without a value it has no knob, so
// that no place is suggested.
Box Setter::slider(const Page::Slider& slider) {
    const double length = column(), x = (width_ - length) / 2, knob = 0.55 * em_, top = y;
    const double line = top + 1.9 * em_;
    const Block low = block(slider.low, 0.8, false, length / 2.2),
                high = block(slider.high, 0.8, false, length / 2.2),
                value = block(slider.value, 0.9, true, length);
    if (drawing) {
        ink(palette_.ink);
        cairo_set_line_width(cairo_, 3);
        for (const double end : {0.0, 1.0}) {
            cairo_move_to(cairo_, x + end * length, line - 0.4 * em_);
            cairo_line_to(cairo_, x + end * length, line + 0.4 * em_);
        }
        cairo_move_to(cairo_, x, line);
        cairo_line_to(cairo_, x + length, line);
        cairo_stroke(cairo_);
        const Block &left = mirrored_ ? high : low, &right = mirrored_ ? low : high;
        put(left, x, line + 0.8 * em_);
        put(right, x + length - right.width, line + 0.8 * em_);
        if (slider.share) {
            const double at = x + (mirrored_ ? 1 - *slider.share : *slider.share) * length;
            rounded(at - knob, line - knob, 2 * knob, 2 * knob, knob);
            fill(palette_.ink, palette_.paper, 2);
            ink(palette_.ink);
            put(value, std::clamp(at - value.width / 2, 0.0, width_ - value.width), top);
        }
    }
    y = line + 0.8 * em_ + std::max({low.height, high.height, 0.2 * em_});
    return {static_cast<int>(x), static_cast<int>(top), static_cast<int>(length),
            static_cast<int>(y - top)};
}

std::vector<Box> Setter::pictures(const Page::Pictures& pictures) {
    std::vector<Box> boxes = gridOf(pictures, static_cast<int>(width_), static_cast<int>(2 * em_));
    double bottom = y;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        Box& box = boxes[i];
        box.y += static_cast<int>(y);
        const Block label =
            block(i < pictures.names.size() ? pictures.names[i] : "", 1, true, width_);
        if (drawing) {
            ink(palette_.ink);
            put(label, box.x + (box.width - label.width) / 2, box.y + box.height + 0.3 * em_);
        }
        tooWide |= box.x < 0;
        bottom = std::max(bottom, box.y + box.height + 2 * em_);
    }
    y = bottom;
    return boxes;
}

// A key's cap, and beside or below it what the key says; together no wider than `widest`, if that
// can be.
Setter::Card Setter::card(const Page::Option& option, double widest, bool stacked) const {
    const double around = (stacked ? 1 : 1.6) * em_, inCap = em_, beside = 0.8 * em_;
    Card card;
    card.chosen = option.chosen;
    card.stacked = stacked;
    card.key = block(option.key, 0.9, true, widest - around - inCap);
    const double cap = std::max(card.key.width, em_) + inCap;
    card.width = cap + around;
    card.height = card.key.height + 1.8 * em_;
    if (option.label.empty())
        return card;
    Layout label = lay(option.label, 1, false, widest - (stacked ? around : card.width + beside),
                       option.language.empty() ? script_ : Script{option.language});
    pango_layout_set_wrap(label.get(), breaksWords ? PANGO_WRAP_WORD_CHAR : PANGO_WRAP_WORD);
    if (stacked)
        pango_layout_set_alignment(label.get(), PANGO_ALIGN_CENTER);
    narrow(label.get());
    card.label = boxed(std::move(label));
    if (stacked) {
        card.width = std::max(cap, card.label.width) + around;
        card.height = capHeight(card) + card.label.height + 1.7 * em_;
    } else {
        card.width += card.label.width + beside;
        card.height = std::max(card.key.height, card.label.height) + 1.8 * em_;
    }
    return card;
}

void Setter::drawCard(const Card& card, double x, double width) const {
    const double writing = card.chosen ? (palette_.ink < 0.5 ? 1 : 0) : palette_.ink;
    rounded(x, y, width, card.height, 0.4 * em_);
    fill(card.chosen ? palette_.ink : palette_.card, palette_.edge, card.chosen ? 4 : 2);

    const Block &key = card.key, &label = card.label;
    const double capWidth = std::max(key.width, em_) + em_, cap = capHeight(card);
    const double centre = x + width / 2;
    const double inner = x + (width - card.width) / 2 + 0.8 * em_,
                 outer = x + (width + card.width) / 2 - 0.8 * em_ - capWidth;
    const double left = std::round(card.stacked ? centre - capWidth / 2
                                   : mirrored_  ? outer
                                                : inner);
    const double middle = card.stacked ? y + 0.6 * em_ + cap / 2 : y + card.height / 2;
    ink(writing);
    cairo_set_line_width(cairo_, 2);
    put(key, left + (capWidth - key.width) / 2, middle - key.height / 2);
    if (!label.layout) // the card itself is the key
        return;
    rounded(left, middle - cap / 2, capWidth, cap, 0.25 * em_);
    cairo_stroke(cairo_);
    if (card.stacked)
        put(label, centre - label.width / 2, middle + cap / 2 + 0.5 * em_);
    else
        put(label, mirrored_ ? left - 0.8 * em_ - label.width : left + capWidth + 0.8 * em_,
            middle - label.height / 2);
}

std::vector<Setter::Card> Setter::cards(const std::vector<Page::Option>& options, double widest,
                                        bool stacked) const {
    std::vector<Card> cards;
    for (const Page::Option& option : options)
        cards.push_back(card(option, widest, stacked));
    return cards;
}

// Side by side, of one size, centred; the first is where reading begins. But the first of images
// that stand beside each other is the left one on any page, and so is its option. The labels of
// many options stand below their keys where they would be broken beside them.
std::vector<Box> Setter::options(const std::vector<Page::Option>& options, bool ofImages) {
    constexpr std::size_t many = 4;
    const double count = static_cast<double>(options.size());
    double space = 1.6 * em_;
    const auto widest = [&] {
        return std::floor((width_ - 2 * em_ - (count - 1) * space) / count);
    };
    std::vector<Card> row = cards(options, widest(), false);
    if (options.size() >= many && std::any_of(row.begin(), row.end(), [](const Card& card) {
            return card.label.layout && pango_layout_get_line_count(card.label.layout.get()) > 1;
        })) {
        space = 0.6 * em_;
        row = cards(options, widest(), true);
    }
    double width = 0, height = 0;
    for (const Card& card : row) {
        width = std::max(width, card.width);
        height = std::max(height, card.height);
    }
    tooWide |= width > widest();
    const bool fromRight = mirrored_ && !ofImages;
    double x = std::round((width_ - count * width - (count - 1) * space) / 2);
    if (fromRight)
        x += (count - 1) * (width + space);
    std::vector<Box> boxes;
    for (Card& card : row) {
        card.height = height;
        if (drawing)
            drawCard(card, x, width);
        boxes.push_back({static_cast<int>(x), static_cast<int>(y), static_cast<int>(width),
                         static_cast<int>(height)});
        x += fromRight ? -width - space : width + space;
    }
    y += height;
    return boxes;
}

// All as wide as the widest, their keys in one column.
std::vector<Box> Setter::list(const std::vector<Page::Option>& options) {
    std::vector<Card> column = cards(options, width_ - 2 * em_, false);
    double width = 0, height = 0;
    for (const Card& card : column) {
        width = std::max(width, card.width);
        height = std::max(height, card.height);
    }
    tooWide |= width > width_ - 2 * em_;
    const double x = std::round((width_ - width) / 2);
    std::vector<Box> boxes;
    for (Card& card : column) {
        y += boxes.empty() ? 0 : 0.5 * em_;
        card.width = width;
        card.height = height;
        if (drawing)
            drawCard(card, x, width);
        boxes.push_back({static_cast<int>(x), static_cast<int>(y), static_cast<int>(width),
                         static_cast<int>(height)});
        y += height;
    }
    return boxes;
}

} // namespace obscura
