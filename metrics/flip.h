#pragma once

#include "image/image.h"

namespace obscura {

// LDR-FLIP: how well a person sees the difference of two images that alternate on a screen
// (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", HPG 2020), with the constants of the authors' release 1.6.
struct FlipError {
    Image map;       // per pixel, one channel: 0, no difference seen, to 1, as large as can be
    double mean = 0; // over the pixels that are `shown`; NaN without any. The authors' program adds
                     // in single precision, so its own mean drifts with the number of pixels.
};

// Of two images of one size, sRGB with 3 channels or grey with 1; symmetric. `shown` has one entry
// per pixel, or none when all are. The default is the authors' observer: a screen 3840 pixels and
// 0.7 m wide, 0.7 m away. Pixels beyond the border are as the nearest one inside.
FlipError flipError(const Image8& first, const Image8& second, const std::vector<bool>& shown = {},
                    double pixelsPerDegree = 67.02);

} // namespace obscura
