#pragma once

#include "bench/sweep/row.h"
#include "image/image.h"
#include "protocols/reader/display.h"

namespace obscura {

// Of visibility, 1 channel: RMSE, bias and SSIM of its linear values, FLIP of both shown as sRGB
// grey. Over the pixels that show a surface.
PictureError visibilityError(const Image& image, const Image& truth,
                             const std::vector<bool>& shown);

// Of lit images, sRGB: RMSE, bias and SSIM of the luma of their code values (0 ... 1), FLIP of the
// images. A bias above 0 is too dark, as everywhere. The predicted JOD is of the whole images, as a
// person sees them on the display, background and all.
PictureError litError(const Image8& image, const Image8& truth, const std::vector<bool>& shown,
                      const Display& display);

} // namespace obscura
