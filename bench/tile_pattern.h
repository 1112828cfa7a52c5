#pragma once

#include "bench/failure_view.h"

namespace obscura {

// Visible repetition of a noise tile, in a patch of an image whose truth is constant along rows.

// The image with each row of the selection replaced by its mean there: the grain taken away.
Image withRowsLevelled(const Image& image, const Selection& patch);

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
