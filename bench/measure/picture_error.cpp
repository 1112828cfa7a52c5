#include "bench/measure/picture_error.h"

#include "metrics/color_video_vdp.h"
#include "metrics/flip.h"
#include "metrics/image_error.h"

namespace obscura {

namespace {

PictureError errorOf(const Image& image, const Image& truth, const Image8& imageShown,
                     const Image8& truthShown, const std::vector<bool>& shown) {
    const ImageError error = imageError(image, truth, shown);
    return {error.rmse, error.bias, error.ssim, flipError(imageShown, truthShown, shown).mean};
}

} // namespace

PictureError visibilityError(const Image& image, const Image& truth,
                             const std::vector<bool>& shown) {
    return errorOf(image, truth, displayed(image), displayed(truth), shown);
}

PictureError litError(const Image8& image, const Image8& truth, const std::vector<bool>& shown,
                      const Display& display) {
    PictureError error = errorOf(lumaOf(image), lumaOf(truth), image, truth, shown);
    error.jod = predictedDifference(image, truth, display).jod;
    return error;
}

} // namespace obscura
