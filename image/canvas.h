#pragma once

#include "base/markup.h"
#include "image/image.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

struct _cairo; // NOLINT(bugprone-reserved-identifier): so Cairo calls what cairo_t is

namespace obscura {

// A page of pictures and words (Cairo and Pango), white unless told. A page that Cairo cannot make
// is an Error: one of more than 32,767 pixels across or down, for instance, of which Cairo makes a
// surface without data that says so only when asked.
class Canvas {
  public:
    Canvas(int width, int height, double grey = 1); // sRGB, 0 ... 1
    ~Canvas();

    // For what sets type and draws by itself.
    _cairo* cairo() const;

    // Pango markup; the size is in pixels.
    void text(int x, int y, const std::string& markup, int size);
    void image(int x, int y, const Image8& image); // 3 channels
    // Draws an edge around a picture, without which white visibility could not be told from the
    // white page.
    void frame(int x, int y, int width, int height);

    Image8 finish() const;

  private:
    struct Owned;
    std::unique_ptr<Owned> owned_;
};

// A long table is cut into pages of whole rows, as even as can be and at most 16,000 pixels high
// (more where a single row is), which viewers and browsers still open.
struct PageRows {
    std::size_t first = 0, last = 0; // rows first ... last - 1
};
std::vector<PageRows> pagesOf(std::size_t rows, int rowHeight, int headerHeight);

// "sheet.png" of an only page, else "sheet-1.png" and so on; `page` counts from 0.
std::string pageName(const std::string& stem, std::size_t page, std::size_t pages);

// The title itself, or with the page's number behind it.
std::string pageTitle(const std::string& title, std::size_t page, std::size_t pages);

// Visibility as code values, 3 channels.
Image8 grey(const Image& visibility);
// White where two images of visibility agree, red where the first is darker, blue where it is
// lighter; full colour from a difference of `full`.
Image8 signedError(const Image& image, const Image& reference, float full);

// Values from 0, black, to `full` and more, a pale yellow, by matplotlib's colour map "magma",
// whose lightness rises evenly.
Image8 magma(const Image& values, float full);

// Box-filtered on code values: a thumbnail to recognise, not to measure.
Image8 shrunk(const Image8& from, int width, int height);

Image8 sideBySide(const Image8& left, const Image8& right); // of one height, with a gap

} // namespace obscura
