#pragma once

#include "image/image.h"
#include "protocols/reader/display.h"

#include <array>
#include <vector>

namespace obscura {

// How far apart two still images look on a display: ColorVideoVDP (Mantiuk, Hanji, Ashraf, Asano
// and Chapiro, "ColorVideoVDP: A visual difference predictor for image, video and display
// distortions", SIGGRAPH 2024), with the numbers of the authors' release 0.5.6. It predicts how
// faithful a test is to a reference, not how realistic it looks, and was not made for ambient
// occlusion: whoever shows it says "predicted". Each image is seen relative to its own mean, so
// that a picture which is brighter all over loses nothing.
struct PredictedDifference {
    double jod =
        10;    // just-objectionable differences: 10, none; at 9, 75 of 100 prefer the reference
    Image map; // 1 channel: 1 - JOD / 10 at each pixel, 0 (none) ... 1; empty unless asked for
    // Per band, the finest first and the base last: its frequency, and the differences of the
    // achromatic, red-green and yellow-violet channels over all pixels, without their weights.
    struct Band {
        double cyclesPerDegree = 0;
        std::array<double, 3> pooled{};
    };
    std::vector<Band> bands;
};

// Of two images of one size, sRGB with 3 channels or grey with 1. Equal images give exactly 10. The
// time is below that of FLIP, the memory 20 floats a pixel (bench/metrics/compare).
PredictedDifference predictedDifference(const Image8& test, const Image8& reference,
                                        const Display& display, bool withMap = false);

} // namespace obscura
