#pragma once

#include "experiment/page.h"
#include "image/image.h"

#include <string>
#include <vector>

namespace obscura {

struct DrawnPage {
    Image8 image;              // RGB
    std::vector<Box> options;  // where one can click: options, fields, sliders, from the top
    std::vector<Box> pictures; // where the images belong
};

// Sets a page on the study's grey, in near-black or near-white, whichever contrasts more. The type
// is sized to be read at arm's length (a capital letter is about 1/50 of the screen's height) in
// lines of at most some 65 characters; a long text is set smaller, down to 3/5 of that, but never
// too small to read. An Error says so when it does not fit even then. Paragraphs run as the page
// does from right to left, and otherwise as their first letter.
DrawnPage drawPage(const Page& page, int width, int height, int grey);

// The characters of a text for which no installed font has a glyph, so that only boxes would be
// drawn, each once and as people look them up: "図 (U+56F3)". Control characters are among them.
std::vector<std::string> unshowable(const std::string& text);

} // namespace obscura
