#pragma once

#include "bench/stability/failure_view.h"

namespace obscura {

// How visibly a noise tile repeats in a patch of an image. The truth in that patch must be constant
// along its diagonals, from the top left to the bottom right. (Were it constant along rows or
// columns, a blur that stops at edges would still take in the tile's whole width.)

// The image without its grain: the selected pixels of each diagonal are replaced by their mean.
Image withDiagonalsLevelled(const Image& image, const Selection& patch);

// The part of the grain (the difference of the two images) that repeats every `period` pixels
// across and down. It is the energy at the harmonics of the tile, which is what remains in the mean
// over all tiles.
struct TilePattern {
    double amplitude = 0; // root mean square
    double share = 0;     // of the grain's energy, less what as much grain without any order would
                          // leave (tile pixels / patch pixels); 0 ... 1, 0 without grain
};
TilePattern tilePattern(const Image& image, const Image& levelled, const Selection& patch,
                        int period);

} // namespace obscura
