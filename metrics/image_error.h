#pragma once

#include "image/image.h"

namespace obscura {

// How far a visibility image is from a reference, over the pixels that show a surface; both have
// one channel. Errors are of linear visibility with a peak of 1.
struct ImageError {
    double rmse = 0;
    double bias = 0;          // mean difference of occlusion: above 0, the image is too dark
    double biasFree = 0;      // rmse with the bias taken away
    double ssim = 0;          //
    double meanOcclusion = 0; // of the image
};
ImageError imageError(const Image& image, const Image& reference, const std::vector<bool>& shown);

// Structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004) of two images of one channel and
// a range of 1: windows of 11 x 11 weighted by a Gaussian of 1.5 pixels, K1 = 0.01, K2 = 0.03. The
// mean over those windows that lie inside the image and whose centre is `shown`; NaN without any.
// `map`, when there is one, gets each such window's at its centre, and 1 elsewhere.
double structuralSimilarity(const Image& first, const Image& second, const std::vector<bool>& shown,
                            Image* map = nullptr);

// Of sRGB code values, 3 channels or 1, as 0 ... 1: Rec. 709's weights on them.
Image lumaOf(const Image8& image);

} // namespace obscura
