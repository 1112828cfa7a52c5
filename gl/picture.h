#pragma once

#include "gl/object.h"

#include <cstdint>
#include <span>

namespace obscura::gl {

// An image in graphics memory that is only ever copied texel to pixel: no filter, no blending, no
// sRGB conversion, so its code values reach the framebuffer as they are in the file.
class Picture {
  public:
    Picture() = default; // nothing
    // Rows from the top; 3 (RGB) or 4 channels, whose alpha is ignored.
    Picture(int width, int height, int channels, std::span<const std::uint8_t> pixels);

    int width() const { return width_; }
    int height() const { return height_; }

    // Copies to the back buffer with the top left corner at (x, y) from the top left of a
    // framebuffer of that height.
    void draw(int x, int y, int framebufferHeight) const;

  private:
    int width_ = 0, height_ = 0;
    Texture texture_;
    Framebuffer framebuffer_;
};

} // namespace obscura::gl
