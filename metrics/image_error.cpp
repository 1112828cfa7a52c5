#include "metrics/image_error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace obscura {

namespace {

constexpr int reach = 5; // of a window from its centre, pixels

std::array<double, 2 * reach + 1> window() {
    std::array<double, 2 * reach + 1> weights{};
    double sum = 0;
    for (int i = -reach; i <= reach; ++i)
        sum += weights[static_cast<std::size_t>(i + reach)] = std::exp(-i * i / (2 * 1.5 * 1.5));
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

// Values of pixels, filtered by the window where it lies inside: the result is smaller by `reach`
// on every side. In double precision, because variances are small differences of large numbers.
std::vector<double> filtered(const std::vector<double>& values, int width, int height) {
    static const auto weights = window();
    const int narrow = width - 2 * reach, low = height - 2 * reach;
    std::vector<double> rows(static_cast<std::size_t>(narrow) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < narrow; ++x)
            for (int i = 0; i <= 2 * reach; ++i)
                rows[static_cast<std::size_t>(y * narrow + x)] +=
                    weights[static_cast<std::size_t>(i)] *
                    values[static_cast<std::size_t>(y * width + x + i)];
    std::vector<double> result(static_cast<std::size_t>(narrow) * static_cast<std::size_t>(low));
    for (int y = 0; y < low; ++y)
        for (int i = 0; i <= 2 * reach; ++i)
            for (int x = 0; x < narrow; ++x)
                result[static_cast<std::size_t>(y * narrow + x)] +=
                    weights[static_cast<std::size_t>(i)] *
                    rows[static_cast<std::size_t>((y + i) * narrow + x)];
    return result;
}

} // namespace

double structuralSimilarity(const Image& first, const Image& second, const std::vector<bool>& shown,
                            Image* map) {
    assert(first.pixels.size() == second.pixels.size() && first.channels == 1);
    const int width = first.width, height = first.height;
    if (map)
        *map = {width, height, 1, std::vector<float>(first.pixels.size(), 1)};
    if (width <= 2 * reach || height <= 2 * reach)
        return std::numeric_limits<double>::quiet_NaN();
    const auto moment = [&](const Image& a, const Image* b) {
        std::vector<double> values(a.pixels.begin(), a.pixels.end());
        for (std::size_t i = 0; b && i < values.size(); ++i)
            values[i] *= static_cast<double>(b->pixels[i]);
        return filtered(values, width, height);
    };
    const auto meanA = moment(first, nullptr), meanB = moment(second, nullptr),
               squareA = moment(first, &first), squareB = moment(second, &second),
               product = moment(first, &second);
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < meanA.size(); ++i) {
        const auto narrow = static_cast<std::size_t>(width - 2 * reach);
        const std::size_t x = i % narrow + reach, y = i / narrow + reach;
        const std::size_t centre = y * static_cast<std::size_t>(width) + x;
        if (!shown[centre])
            continue;
        const double a = meanA[i], b = meanB[i];
        const double varianceA = squareA[i] - a * a, varianceB = squareB[i] - b * b,
                     covariance = product[i] - a * b;
        const double similarity = (2 * a * b + c1) * (2 * covariance + c2) /
                                  ((a * a + b * b + c1) * (varianceA + varianceB + c2));
        if (map)
            map->pixels[centre] = static_cast<float>(similarity);
        sum += similarity;
        ++count;
    }
    return count ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

Image lumaOf(const Image8& image) {
    assert(image.channels == 1 || image.channels == 3);
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t green = channels == 1 ? 0 : 1, blue = channels == 1 ? 0 : 2;
    Image luma{image.width, image.height, 1, {}};
    luma.pixels.reserve(image.pixels.size() / channels);
    for (std::size_t i = 0; i < image.pixels.size(); i += channels)
        luma.pixels.push_back((0.2126F * static_cast<float>(image.pixels[i]) +
                               0.7152F * static_cast<float>(image.pixels[i + green]) +
                               0.0722F * static_cast<float>(image.pixels[i + blue])) /
                              255);
    return luma;
}

ImageError imageError(const Image& image, const Image& reference, const std::vector<bool>& shown) {
    assert(image.pixels.size() == reference.pixels.size());
    ImageError error;
    double squares = 0, count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (!shown[i])
            continue;
        const double value = static_cast<double>(image.pixels[i]);
        const double tooDark = static_cast<double>(reference.pixels[i]) - value;
        squares += tooDark * tooDark;
        error.bias += tooDark;
        error.meanOcclusion += 1 - value;
        ++count;
    }
    if (count > 0) {
        error.bias /= count;
        error.meanOcclusion /= count;
        error.rmse = std::sqrt(squares / count);
        error.biasFree = std::sqrt(std::max(squares / count - error.bias * error.bias, 0.0));
    }
    error.ssim = structuralSimilarity(image, reference, shown);
    return error;
}

} // namespace obscura
