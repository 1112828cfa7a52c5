#pragma once

#include "bench/stability/failure_view.h"

namespace obscura {

// Visible repetition of a noise tile, in a patch of an image whose truth is constant along its
// diagonals, from the top left to the bottom right: along rows or columns a blur that stops at
// edges would still meet the tile's whole width.

// The image with the selected pixels of each diagonal replaced by their mean: its grain taken away.
Image withDiagonalsLevelled(const Image& image, const Selection& patch);

// What of the grain (the difference of the two) repeats every `period` pixels both ways: the energy
// at the harmonics of the tile, which is what the mean over all tiles leaves.
struct TilePattern {
    double amplitude = 0; // root mean square
    double share = 0;     // of the grain's energy, less what as much grain without any order would
                          // leave (tile pixels / patch pixels); 0 ... 1, 0 without grain
};
TilePattern tilePattern(const Image& image, const Image& levelled, const Selection& patch,
                        int period);

} // namespace obscura
