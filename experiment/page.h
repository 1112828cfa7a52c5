#pragma once

#include <optional>
#include <string>
#include <vector>

namespace obscura {

// A page of text for the participant. All of it is UTF-8; empty parts take no room. Line breaks in
// `text` are kept.
struct Page {
    struct Option {
        std::string key;           // drawn as a key cap: "1", "Space"
        std::string label;         // beside it
        bool chosen = false;       // drawn the other way round, in a thick frame
        std::string language = {}; // of the label, where it is not the page's
    };
    struct Field {
        std::string typed; // so far
        bool focus = true; // shows a caret
    };
    struct Slider {
        std::optional<double> share; // of its way from low to high, 0 ... 1; none: not yet set
        std::string low, high;       // what stands at its ends
        std::string value;           // what stands above its knob
    };
    // One question among others on a page: what it asks, and one of the three that answer it.
    struct Part {
        std::string label;
        bool focus = false;
        std::vector<Option> options;
        bool ofImages = false; // the options go from left to right, as the images do
        std::optional<Field> field;
        std::optional<Slider> slider;
    };
    // A line of a small table: what it is, and how it stands.
    struct Fact {
        std::string name, value;
    };
    // Room for images of one size, below each the name that answers have for it, or nothing.
    struct Pictures {
        int count = 0, width = 0, height = 0; // pixels
        std::vector<std::string> names = {};
    };

    std::string language;     // a BCP 47 tag: of characters that several languages share, it has
                              // the shape that its readers know; "" for none in particular
    bool rightToLeft = false; // the first option and a slider's low end are on the right
    std::string warning;      // a band across the top
    Pictures pictures;
    std::string heading;
    std::vector<Fact> facts;
    std::string text;
    std::optional<Field> field;
    std::string note; // small, below
    std::vector<Part> parts;
    std::vector<Option> options;
    bool ofImages = false; // as in a part
    bool listed = false;   // the options stand below each other
};

struct Box {
    int x = 0, y = 0, width = 0, height = 0;

    bool contains(int px, int py) const {
        return px >= x && px < x + width && py >= y && py < y + height;
    }
};

// Where so many images of one size go, side by side, in as many rows as they need to fit into that
// width; `below` is free under each row. From the top left corner of them all.
std::vector<Box> gridOf(const Page::Pictures& pictures, int width, int below);

} // namespace obscura
