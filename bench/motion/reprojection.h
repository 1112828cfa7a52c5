#pragma once

#include "image/image.h"
#include "renderer/frame/surfaces.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace obscura {

// Where the points that one frame shows lie in another frame of the same, static scene: exact
// optical flow, from depth and both cameras. Pixels and rows as in images, from the top.
//
// A point counts as visible in the other frame (M of the measures) where every pixel that a
// bilinear fetch there would read shows its surface: within half a pixel's width of its tangent
// plane, with a normal at most 25 degrees off.
class Reprojection {
  public:
    // Both of one size.
    Reprojection(const Surfaces& from, const Surfaces& to);

    bool valid(std::size_t pixel) const { return places_[pixel].x >= 0; }
    // Coordinates in the other frame of a valid pixel's point; whole numbers are centres.
    glm::vec2 place(std::size_t pixel) const { return places_[pixel]; }
    // What the other frame's image has there, bilinearly: exact for what is linear across a pixel,
    // and a blur of what is not. A pattern of s pixels a period that moves by half a pixel loses
    // 1 - cos(pi / s) of its amplitude: all of a checkerboard, 5 % at ten pixels.
    float fetch(const Image& image, std::size_t pixel) const;
    // The pixel of the other frame that shows the point's surface, the nearest of those around its
    // place that are within two pixels' widths of its tangent plane, whatever their normals.
    // Nothing where there is none: the point was hidden, or outside of the frame.
    std::optional<std::size_t> seenAt(std::size_t pixel) const;

  private:
    std::vector<glm::vec2> places_;  // -1 where the point is not visible
    std::vector<std::int64_t> seen_; // pixels; -1: none
};

} // namespace obscura
