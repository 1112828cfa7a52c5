#include "stimuli/boost.h"

#include "base/files.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace obscura {

namespace {

constexpr const char* layer = "rendered";
constexpr int support = 3; // pixels on either side

std::uint8_t code(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

Image8 amplified(const Image8& image, const Image8& reference, double factor) {
    Image8 result{image.width, image.height, image.channels, {}};
    result.pixels.reserve(image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        result.pixels.push_back(
            code(reference.pixels[i] + factor * (image.pixels[i] - reference.pixels[i])));
    return result;
}

double lanczos(double x) {
    if (std::abs(x) < 1e-9)
        return 1;
    if (std::abs(x) >= support)
        return 0;
    const double angle = std::numbers::pi * x;
    return support * std::sin(angle) * std::sin(angle / support) / (angle * angle);
}

// One sample of a row: which pixels it is made of, and how much of each.
struct Taps {
    int first = 0;
    double weights[2 * support] = {};
};

Taps tapsAt(double position) {
    Taps taps;
    taps.first = static_cast<int>(std::floor(position)) - support + 1;
    double sum = 0;
    for (int i = 0; i < 2 * support; ++i)
        sum += taps.weights[i] = lanczos(position - (taps.first + i));
    for (double& weight : taps.weights)
        weight /= sum;
    return taps;
}

// The same number of rows, each `width` samples from `from` on, `magnify` to a pixel. Beyond the
// borders, their pixels go on.
Image acrossMagnified(const Image& image, int width, int from, int magnify) {
    Image result{width, image.height, image.channels, {}};
    result.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(image.height) *
                         static_cast<std::size_t>(image.channels));
    for (int x = 0; x < width; ++x) {
        const Taps taps = tapsAt(from + (x + 0.5) / magnify - 0.5);
        for (int y = 0; y < image.height; ++y)
            for (int channel = 0; channel < image.channels; ++channel) {
                double sum = 0;
                for (int i = 0; i < 2 * support; ++i)
                    sum += taps.weights[i] *
                           image.at(std::clamp(taps.first + i, 0, image.width - 1), y, channel);
                result.at(x, y, channel) = static_cast<float>(sum);
            }
    }
    return result;
}

Image transposed(const Image& image) {
    Image result{image.height, image.width, image.channels, {}};
    result.pixels.resize(image.pixels.size());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int channel = 0; channel < image.channels; ++channel)
                result.at(y, x, channel) = image.at(x, y, channel);
    return result;
}

Image8 magnified(const Image8& image, const Derivation& how) {
    if (how.magnify == 1)
        return image;
    Image values{image.width, image.height, image.channels, {}};
    values.pixels.assign(image.pixels.begin(), image.pixels.end());
    values = acrossMagnified(values, image.width, how.crop[0], how.magnify);
    values =
        transposed(acrossMagnified(transposed(values), image.height, how.crop[1], how.magnify));
    Image8 result{image.width, image.height, image.channels, {}};
    std::transform(values.pixels.begin(), values.pixels.end(), std::back_inserter(result.pixels),
                   [](float value) { return code(value); });
    return result;
}

Image8 boostedFrom(const Manifest& manifest, const ConditionRecord& condition,
                   const ImageRecord& image, const Derivation& how) {
    const auto load = [&](const ImageRecord& record) {
        return readImage8(manifest.folder / renderedOf(record).path, 3);
    };
    return boosted(load(image), load(condition.image(how.reference)), how);
}

} // namespace

Image8 boosted(const Image8& image, const Image8& reference, const Derivation& how) {
    return magnified(amplified(image, reference, how.amplify), how);
}

const FileRecord& renderedOf(const ImageRecord& image) {
    return image.derived ? image.layers.at(layer) : image.image;
}

Derivation derivationOf(const Protocol& protocol, const ConditionRecord& condition,
                        const ImageRecord& image) {
    const Boost& boost = *protocol.boost;
    return {renderedOf(image).sha256,
            boost.reference,
            renderedOf(condition.image(boost.reference)).sha256,
            boost.amplify,
            boost.magnify,
            boost.crop.at(condition.view)};
}

void boostImages(const Protocol& protocol, Manifest& manifest) {
    for (ConditionRecord& condition : manifest.conditions)
        for (ImageRecord& image : condition.images) {
            const Derivation how = derivationOf(protocol, condition, image);
            const Image8 result = boostedFrom(manifest, condition, image, how);
            const std::string name =
                std::filesystem::path(image.image.path).stem().string() + "_boosted.png";
            writePng(manifest.folder / name, result);
            image.layers[layer] =
                std::exchange(image.image, {name, sha256File(manifest.folder / name)});
            image.derived = how;
        }
}

ImageRecord unboosted(ImageRecord image) {
    if (!image.derived)
        return image;
    image.image = renderedOf(image);
    image.layers.erase(layer);
    image.derived.reset();
    return image;
}

std::string faultOfBoost(const Protocol& protocol, const Manifest& manifest,
                         const ConditionRecord& condition, const ImageRecord& image) {
    if (protocol.boost.has_value() != image.derived.has_value())
        return protocol.boost ? "is not boosted, as the protocol asks"
                              : "is boosted, which the protocol does not ask";
    if (!protocol.boost)
        return "";
    const Derivation how = derivationOf(protocol, condition, image);
    if (how != *image.derived)
        return "was boosted otherwise than the protocol asks now, or from other images";
    const Image8 now = boostedFrom(manifest, condition, image, how);
    return readImage8(manifest.folder / image.image.path, 3).pixels == now.pixels
               ? ""
               : "is not what boosting the rendered images gives";
}

} // namespace obscura
