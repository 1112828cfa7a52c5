#include "image/image.h"

#include "base/error.h"
#include "base/files.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace obscura {

namespace {

constexpr OIIO::TypeDesc::BASETYPE typeOf(std::uint8_t) { return OIIO::TypeDesc::UINT8; }
constexpr OIIO::TypeDesc::BASETYPE typeOf(float) { return OIIO::TypeDesc::FLOAT; }

// Grey repeats into missing colour channels; missing alpha is opaque.
template <typename T>
std::vector<T> withChannels(const std::vector<T>& from, int have, int want, T opaque) {
    if (have == want)
        return from;
    const std::size_t count = from.size() / static_cast<std::size_t>(have);
    std::vector<T> to(count * static_cast<std::size_t>(want));
    const bool alpha = have == 2 || have == 4;
    const int colours = alpha ? have - 1 : have;
    for (std::size_t i = 0; i < count; ++i)
        for (int c = 0; c < want; ++c) {
            T value = opaque;
            if (c < 3)
                value = from[i * static_cast<std::size_t>(have) +
                             static_cast<std::size_t>(colours == 1 ? 0 : std::min(c, colours - 1))];
            else if (alpha)
                value =
                    from[i * static_cast<std::size_t>(have) + static_cast<std::size_t>(colours)];
            to[i * static_cast<std::size_t>(want) + static_cast<std::size_t>(c)] = value;
        }
    return to;
}

// Across or down: what every OpenGL 4.5 takes as a texture. Of pixels, so that a header that lies
// costs no more than 1 GiB.
constexpr int mostAcross = 16384;
constexpr std::int64_t mostPixels = std::int64_t{1} << 28;

void checkSize(const OIIO::ImageSpec& spec, const std::string& name) {
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.width > mostAcross ||
        spec.height > mostAcross || std::int64_t{spec.width} * spec.height > mostPixels ||
        spec.nchannels > 64 || spec.depth > 1)
        throw Error(
            {name, 0, 0, {}},
            fmt::format("expected an image of at most {0} pixels across and down and {1} in "
                        "all, found {2} x {3}; make it smaller",
                        mostAcross, mostPixels, spec.width, spec.height));
}

template <typename ImageType>
ImageType read(OIIO::ImageInput* input, const std::string& name, int channels) {
    if (!input)
        throw Error({name, 0, 0, {}},
                    fmt::format("expected an image, cannot read it: {}", OIIO::geterror()));
    const OIIO::ImageSpec& spec = input->spec();
    checkSize(spec, name);
    ImageType image;
    image.width = spec.width;
    image.height = spec.height;
    image.channels = spec.nchannels;
    image.pixels.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    using Value = typename decltype(image.pixels)::value_type;
    if (!input->read_image(0, 0, 0, -1, typeOf(Value{}), image.pixels.data()))
        throw Error({name, 0, 0, {}},
                    fmt::format("expected a whole image, cannot read it: {}", input->geterror()));
    if (channels > 0) {
        constexpr Value opaque = std::is_same_v<Value, float> ? Value(1) : Value(255);
        image.pixels = withChannels(image.pixels, image.channels, channels, opaque);
        image.channels = channels;
    }
    return image;
}

// Several images, all as `spec` says, become the frames of one file.
bool writeAll(OIIO::ImageOutput& output, const std::string& name, const OIIO::ImageSpec& spec,
              const OIIO::TypeDesc& type, std::span<const void* const> images) {
    const std::vector<OIIO::ImageSpec> specs(images.size(), spec);
    if (images.size() == 1 ? !output.open(name, spec)
                           : !output.open(name, static_cast<int>(specs.size()), specs.data()))
        return false;
    for (std::size_t i = 0; i < images.size(); ++i)
        if ((i > 0 && !output.open(name, spec, OIIO::ImageOutput::AppendSubimage)) ||
            !output.write_image(type, images[i]))
            return false;
    return output.close();
}

// Encoded in memory, for OpenImageIO's PNG writer overlooks a disk that is full; writeFile() does
// not.
void write(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
           const OIIO::TypeDesc& type, std::span<const void* const> images) {
    std::vector<unsigned char> encoded;
    OIIO::Filesystem::IOVecOutput memory(encoded);
    const auto output = OIIO::ImageOutput::create(path.string(), &memory);
    if (!output || !output->set_ioproxy(&memory) ||
        !writeAll(*output, path.string(), spec, type, images))
        throw Error({path.string(), 0, 0, {}},
                    "cannot be written: " + (output ? output->geterror() : OIIO::geterror()));
    writeFile(path, {reinterpret_cast<const char*>(encoded.data()), encoded.size()});
}

} // namespace

float srgbFromLinear(float linear) {
    linear = std::clamp(linear, 0.0f, 1.0f);
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linearFromSrgb(float code) {
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

Image8 displayed(Image linear) {
    std::transform(linear.pixels.begin(), linear.pixels.end(), linear.pixels.begin(),
                   srgbFromLinear);
    return quantised(linear);
}

Image flipped(const std::vector<float>& values, int width, int height, int have, int first,
              int keep) {
    Image image{width, height, keep, {}};
    image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                        static_cast<std::size_t>(keep));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t from = static_cast<std::size_t>((height - 1 - y) * width + x) *
                                     static_cast<std::size_t>(have);
            for (int c = 0; c < keep; ++c)
                image.at(x, y, c) = values[from + static_cast<std::size_t>(first + c)];
        }
    return image;
}

Image8 quantised(const Image& image) {
    Image8 result{image.width, image.height, image.channels, {}};
    for (const float value : image.pixels)
        result.pixels.push_back(
            // NOLINTNEXTLINE(bugprone-incorrect-roundings): never negative
            static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f));
    return result;
}

Image8 readImage8(const std::filesystem::path& path, int channels) {
    return read<Image8>(OIIO::ImageInput::open(path.string()).get(), path.string(), channels);
}

Image readImage(const std::filesystem::path& path, int channels) {
    return read<Image>(OIIO::ImageInput::open(path.string()).get(), path.string(), channels);
}

Image8 readImage8(std::span<const std::byte> encoded, const std::string& name, int channels) {
    OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(encoded.data()), encoded.size());
    return read<Image8>(OIIO::ImageInput::open(name, nullptr, &memory).get(), name, channels);
}

Image readExr(const std::filesystem::path& path, std::span<const std::string> channelNames) {
    const auto input = OIIO::ImageInput::open(path.string());
    const Image all = read<Image>(input.get(), path.string(), 0);
    const std::vector<std::string>& found = input->spec().channelnames;
    std::vector<std::size_t> order;
    for (const std::string& name : channelNames) {
        const auto place = std::find(found.begin(), found.end(), name);
        if (place == found.end())
            throw Error(
                {path.string(), 0, 0, {}},
                fmt::format("expected a channel \"{}\", found {}", name, fmt::join(found, ", ")));
        order.push_back(static_cast<std::size_t>(place - found.begin()));
    }
    Image image{all.width, all.height, static_cast<int>(order.size()), {}};
    for (std::size_t i = 0; i < all.pixels.size(); i += found.size())
        for (const std::size_t c : order)
            image.pixels.push_back(all.pixels[i + c]);
    return image;
}

void writePng(const std::filesystem::path& path, const Image8& image) {
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    // Level 4 halves the time of the default 6 for a file a few percent larger.
    spec.attribute("png:compressionLevel", 4);
    write(path, spec, OIIO::TypeDesc::UINT8, std::array<const void*, 1>{image.pixels.data()});
}

void writeExr(const std::filesystem::path& path, const Image& image,
              std::span<const std::string> channelNames, bool depth32) {
    assert(channelNames.size() == static_cast<std::size_t>(image.channels));
    OIIO::ImageSpec spec(image.width, image.height, image.channels,
                         depth32 ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::HALF);
    spec.channelnames.assign(channelNames.begin(), channelNames.end());
    spec.attribute("compression", "zip");
    // Else OpenImageIO writes the time of day, and no two files are alike.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    spec.attribute("oiio:ColorSpace", "Linear");
    write(path, spec, OIIO::TypeDesc::FLOAT, std::array<const void*, 1>{image.pixels.data()});
}

void writeGif(const std::filesystem::path& path, std::span<const Image8> frames,
              int framesPerSecond) {
    assert(!frames.empty() && frames[0].channels == 3);
    OIIO::ImageSpec spec(frames[0].width, frames[0].height, 3, OIIO::TypeDesc::UINT8);
    const int rate[] = {framesPerSecond, 1};
    spec.attribute(
        "FramesPerSecond",
        OIIO::TypeDesc(OIIO::TypeDesc::INT, OIIO::TypeDesc::VEC2, OIIO::TypeDesc::RATIONAL), rate);
    std::vector<const void*> images;
    for (const Image8& frame : frames)
        images.push_back(frame.pixels.data());
    write(path, spec, OIIO::TypeDesc::UINT8, images);
}

Difference compare(const Image& first, const Image& second, double threshold) {
    assert(first.pixels.size() == second.pixels.size() && !first.pixels.empty());
    Difference result;
    double squares = 0, sum = 0;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < first.pixels.size(); ++i) {
        const double d =
            static_cast<double>(second.pixels[i]) - static_cast<double>(first.pixels[i]);
        sum += d;
        squares += d * d;
        // Written so that NaN counts as beyond every threshold.
        beyond += !(std::abs(d) <= threshold);
        result.largest = !(std::abs(d) <= result.largest) ? std::abs(d) : result.largest;
    }
    const double count = static_cast<double>(first.pixels.size());
    result.rms = std::sqrt(squares / count);
    result.mean = sum / count;
    result.share = static_cast<double>(beyond) / count;
    return result;
}

} // namespace obscura
