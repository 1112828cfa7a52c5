#pragma once

#include "experiment/page.h"

#include <pango/pangocairo.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What text.cpp sets pages with: type, cards, fields and sliders (Pango and Cairo).

template <auto function>
struct Call {
    template <typename T>
    void operator()(T* object) const {
        function(object);
    }
};
using Layout = std::unique_ptr<PangoLayout, Call<g_object_unref>>;

constexpr double smallestType = 9; // pixels; letters of fewer cannot be told apart

// How a language is written.
struct Script {
    std::string language;                         // a BCP 47 tag; "" for none in particular
    std::optional<PangoDirection> direction = {}; // none: each paragraph's first letter decides
};

// A text with its font, its lines not yet broken.
Layout layOut(cairo_t* cairo, const std::string& text, double pixels, bool bold,
              const Script& script = {});

// Shades of grey that go with the page's own, in [0, 1].
struct Palette {
    double paper, ink, card, edge;
};

Palette paletteFor(int grey); // of a code value, 0 ... 255

// One attempt at a page with type of a given size: places things from top to bottom, either only
// to measure (nothing is drawn) or for good.
class Setter {
  public:
    Setter(cairo_t* cairo, const Palette& palette, int width, double em, const Page& page)
        : cairo_(cairo), palette_(palette), width_(width), em_(em),
          mirrored_(page.rightToLeft), script_{page.language, {}} {
        if (mirrored_)
            script_.direction = PANGO_DIRECTION_RTL;
    }

    double y = 0;
    bool tooWide = false;     // something does not fit between the sides
    bool breaksWords = false; // where a card is too narrow for a word; otherwise that is too wide

    void warning(const std::string& text);
    void paragraph(const std::string& text, double size, bool bold = false);
    void title(const std::string& text, double size, bool bold); // each line in the middle
    void facts(const std::vector<Page::Fact>& facts); // names at the left, values beside them
    Box field(const Page::Field& field);
    Box slider(const Page::Slider& slider);
    std::vector<Box> pictures(const Page::Pictures& pictures);
    // `ofImages`: from left to right on any page.
    std::vector<Box> options(const std::vector<Page::Option>& options, bool ofImages);
    std::vector<Box> list(const std::vector<Page::Option>& options); // below each other
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
        bool chosen = false, stacked = false; // stacked: the label stands below the key
    };

    Layout lay(const std::string& text, double size, bool bold, double wrapAt) const {
        return lay(text, size, bold, wrapAt, script_);
    }
    Layout lay(const std::string& text, double size, bool bold, double wrapAt,
               const Script& script) const;
    static Block boxed(Layout layout);
    Block block(const std::string& text, double size, bool bold, double wrapAt) const {
        return block(text, size, bold, wrapAt, script_);
    }
    Block block(const std::string& text, double size, bool bold, double wrapAt,
                const Script& script) const;
    void ink(double grey) const { cairo_set_source_rgb(cairo_, grey, grey, grey); }
    void rounded(double x, double top, double width, double height, double radius) const;
    void put(const Block& block, double left, double top) const;
    void centred(const std::string& text, double size, bool bold, PangoAlignment lines);
    Card card(const Page::Option& option, double widest, bool stacked) const;
    std::vector<Card> cards(const std::vector<Page::Option>& options, double widest,
                            bool stacked) const;
    double capHeight(const Card& card) const { return card.key.height + 0.6 * em_; }
    void drawCard(const Card& card, double x, double width) const;
    void fill(double shade, double edge, double line) const;
    double column(double size = 1) const; // the width of a text

    cairo_t* cairo_;
    const Palette& palette_;
    double width_, em_;
    bool mirrored_; // right to left
    Script script_;
};

} // namespace obscura
