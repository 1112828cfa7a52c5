#pragma once

#include "image/image.h"

#include <string>
#include <vector>

namespace obscura {

// A page of text for the participant. All of it is UTF-8; empty parts take no room. Line breaks in
// `text` are kept.
struct Page {
    struct Option {
        std::string key;   // drawn as a key cap: "1", "Space"
        std::string label; // beside it
    };

    std::string warning; // a band across the top
    std::string heading;
    std::string text;
    bool hasField = false;
    std::string field; // what has been typed so far
    std::string note;  // small, below
    std::vector<Option> options;
};

struct Box {
    int x = 0, y = 0, width = 0, height = 0;

    bool contains(int px, int py) const {
        return px >= x && px < x + width && py >= y && py < y + height;
    }
};

struct DrawnPage {
    Image8 image;             // RGB
    std::vector<Box> options; // where they can be clicked
};

// Sets a page on the study's grey, in near-black or near-white, whichever contrasts more. The type
// is sized to be read at arm's length (a capital letter is about 1/50 of the screen's height) in
// lines of at most some 65 characters; a long text is set smaller, down to 3/5 of that, but never
// too small to read. An Error says so when it does not fit even then. Paragraphs run from left to
// right or from right to left, as their first letter does.
DrawnPage drawPage(const Page& page, int width, int height, int grey);

// The characters of a text for which no installed font has a glyph, so that only boxes would be
// drawn, each once and as people look them up: "図 (U+56F3)". Control characters are among them.
std::vector<std::string> unshowable(const std::string& text);

} // namespace obscura
