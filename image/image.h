#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace obscura {

// Rows from top to bottom, channels interleaved. Linear values.
struct Image {
    int width = 0, height = 0, channels = 0;
    std::vector<float> pixels;

    float& at(int x, int y, int channel) { return pixels[index(x, y, channel)]; }
    float at(int x, int y, int channel) const { return pixels[index(x, y, channel)]; }

  private:
    std::size_t index(int x, int y, int channel) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(channels) +
               static_cast<std::size_t>(channel);
    }
};

// The same with 8-bit code values, which are sRGB where they hold colour.
struct Image8 {
    int width = 0, height = 0, channels = 0;
    std::vector<std::uint8_t> pixels;
};

// sRGB's transfer function (IEC 61966-2-1) on [0, 1], both ways.
float srgbFromLinear(float linear);
float linearFromSrgb(float code);

// Values in [0, 1] as code values 0 ... 255, rounded, with no transfer function.
Image8 quantised(const Image& image);

// The same of linear values, by sRGB's transfer function: as a display is to show them.
Image8 displayed(Image linear);

// An image from rows that lie bottom first, as OpenGL has them. Of the `have` channels it takes
// `keep`, from `first` on.
Image flipped(const std::vector<float>& values, int width, int height, int have, int first,
              int keep);

// Any file OpenImageIO reads, as stored: 8-bit files to their code values (a deeper file is
// rounded), float files to their values. `channels` 0 keeps the file's; otherwise missing colour
// channels repeat grey, missing alpha is opaque. An Error names the path and the reader's reason.
Image8 readImage8(const std::filesystem::path& path, int channels = 0);
Image readImage(const std::filesystem::path& path, int channels = 0);
// The same from an encoded file in memory; `name` is for errors and picks the format.
Image8 readImage8(std::span<const std::byte> encoded, const std::string& name, int channels = 0);

// The named channels of an EXR file, in this order; a missing one is an Error.
Image readExr(const std::filesystem::path& path, std::span<const std::string> channelNames);

// PNG (8-bit, marked sRGB) and EXR (half or, when `depth32`, float). Written aside, then renamed.
// `channelNames` ("R", "G", "B" or "V") has as many names as the image has channels.
void writePng(const std::filesystem::path& path, const Image8& image);
void writeExr(const std::filesystem::path& path, const Image& image,
              std::span<const std::string> channelNames, bool depth32 = false);

// An animated GIF that repeats for ever, from frames of one size with 3 channels. Greys keep their
// code values to within 1; a frame of more than 255 colours gets the nearest. Players count in
// hundredths of a second. Written aside, then renamed.
void writeGif(const std::filesystem::path& path, std::span<const Image8> frames,
              int framesPerSecond);

// How two images of one size differ, over all channels.
struct Difference {
    double rms = 0;     // root mean square
    double mean = 0;    // signed: second minus first
    double largest = 0; // absolute
    double share = 0;   // of values that differ by more than `threshold`
};
Difference compare(const Image& first, const Image& second, double threshold = 0);

} // namespace obscura
