#pragma once

#include "experiment/form.h"
#include "experiment/page.h"
#include "experiment/text.h"
#include "protocols/reader/protocol.h"

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// What one screen shows: a page that covers it, or else grey, and images upon that.
struct Screenful {
    Page page;                       // from which
    std::optional<DrawnPage> drawn;  // was drawn; nothing: grey alone
    int grey = 128;                  // a code value
    std::vector<std::string> images; // each by its place in the order or its role,
    std::vector<Box> places;         // and where it goes
    int turns = 1;         // > 1: an equal part of the images at a time, as they stand here
    bool mirrored = false; // the page's first option, or slider's low end, is on the right
};

// Lays out a study's screens, all for a display of one size. The presenter shows what this yields,
// and the preview draws it: neither knows another way.
class Screens {
  public:
    // In the language of `texts`, which the protocol has. `warning` stands above every page of
    // text;
    // "" for none.
    Screens(const Protocol& protocol, const Texts& texts, int width, int height,
            std::string warning);

    int width() const { return width_; }
    int height() const { return height_; }

    Screenful page(Page page) const; // with the warning above it
    // A page that has been laid out, as it looks while another window has the keyboard.
    Screenful unfocused(const Screenful& screen) const;
    // Of a phase, in the `trial`th of so many trials. One that asks shows how far `form` has been
    // answered.
    Screenful phase(const Phase& phase, int trial, int trials, const Form& form) const;
    Screenful phase(const Phase& phase, int trial, int trials) const; // nothing answered yet

    // An Error when one of the study's screens does not fit. Texts need most room while another
    // window has the keyboard.
    void check() const;

  private:
    Screenful drawn(Page page) const;
    std::vector<Box> gridOf(const Phase& phase) const;
    Page::Pictures roomFor(const Phase& phase) const;

    const Protocol& protocol_;
    const Texts& texts_;
    int width_, height_;
    std::string warning_;
};

// How many images a study has, all conditions together.
int imageCount(const Protocol& protocol);

} // namespace obscura
