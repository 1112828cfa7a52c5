#include "bench/measure/picture_error.h"

#include "metrics/flip.h"
#include "metrics/image_error.h"

namespace obscura {

namespace {

// Rec. 709 weights on code values.
Image lumaOf(const Image8& image) {
    Image luma{image.width, image.height, 1, {}};
    for (std::size_t i = 0; i < image.pixels.size(); i += 3)
        luma.pixels.push_back((0.2126f * static_cast<float>(image.pixels[i]) +
                               0.7152f * static_cast<float>(image.pixels[i + 1]) +
                               0.0722f * static_cast<float>(image.pixels[i + 2])) /
                              255);
    return luma;
}

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

PictureError litError(const Image8& image, const Image8& truth, const std::vector<bool>& shown) {
    return errorOf(lumaOf(image), lumaOf(truth), image, truth, shown);
}

} // namespace obscura
