#pragma once

#include "gl/object.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace obscura::gl {

// `none` keeps a target's output location free of any texture.
enum class Format { none, r8, r16f, r32f, rg16f, rg32f, rgba8, srgb8, rgba16f, rgba32f, depth32f };

int channelsOf(Format format);
int bytesOf(Format format);          // per pixel
const char* glslName(Format format); // as an image's layout qualifier: "r16f"

// A texture that shaders read by texelFetch or with nearest filtering, clamped at the border;
// depth32f compares instead (sampler2DShadow) with linear filtering.
Texture targetTexture(int width, int height, Format format, const std::string& label);

// How a texture is read by coordinate. Where it is made smaller, OpenGL's six ways in the order of
// their numbers; the first two have no mipmaps, and the last is anisotropic too.
enum class Wrap { repeat, mirrored, clamp };
enum class Minified {
    nearest,
    linear,
    nearestMipmapNearest,
    linearMipmapNearest,
    nearestMipmapLinear,
    linearMipmapLinear
};
struct Sampling {
    Wrap u = Wrap::repeat, v = Wrap::repeat;
    bool nearest = false; // texels are squares where they are enlarged
    Minified minified = Minified::linearMipmapLinear;
};
// `rgba` rows from first to last have v = 0 to v = 1.
Texture imageTexture(int width, int height, bool srgb, std::span<const std::uint8_t> rgba,
                     Sampling sampling);

// Linear floats, 3 channels, filtered within and between its levels; repeats across, clamps at the
// top and bottom. Each level is half as wide and high as the one before, rounded down.
struct FloatLevel {
    int width = 0, height = 0;
    std::span<const float> rgb;
};
Texture filteredTexture(std::span<const FloatLevel> levels);

// A volume of four bytes each, 0 ... 1, x running fastest, filtered within a level, with the levels
// nearest to those asked for; outside it is 0. Each level is half as large as the one before.
struct VolumeLevel {
    int width = 0, height = 0, depth = 0;
    std::span<const std::uint8_t> rgba;
};
Texture volumeTexture(std::span<const VolumeLevel> levels);

// One channel, rows from the bottom, read as targetTexture's are.
Texture floatTexture(int width, int height, std::span<const float> values);

// A texture of one texel.
Texture constantTexture(std::array<float, 4> value);

void bindTexture(int unit, const Texture& texture);

// Which images' textures are filtered anisotropically when they are made; and how to have it
// otherwise for some time.
bool isAnisotropic(bool srgb, Sampling sampling);
void filterAnisotropically(const Texture& texture, bool anisotropically);

// How a target's texture looks where it is shown at another size: pixels as squares, or blended.
void filterLinearly(const Texture& texture, bool linearly);

// The texture's content as it lies in memory, rows from bottom to top; for hashing.
std::vector<std::byte> readBytes(const Texture& texture, int width, int height, Format format);
// The same content as floats, with as many channels as the format has.
std::vector<float> readFloats(const Texture& texture, int width, int height, Format format);
// One texel of level 0 (of an array, of its first layer) by its coordinates from the left and from
// the bottom; channels that the format has not are 0, and alpha then 1.
std::array<float, 4> readTexel(const Texture& texture, int x, int y);
// Replaces the content of a texture of one channel, rows from the bottom.
void writeFloats(const Texture& texture, int width, int height, std::span<const float> values);

// Textures that are drawn into together.
class Target {
  public:
    // `depth` adds a depth32f texture, which comes after the colours or, when there are none, in
    // their place.
    Target(int width, int height, std::span<const Format> colours, bool depth,
           const std::string& label);

    void bind() const; // draw here, viewport to its size
    void clear(int colour, std::array<float, 4> value) const;
    void clearDepth(float value) const;

    int width() const { return width_; }
    int height() const { return height_; }
    const Texture& colour(int index) const { return colours_[static_cast<std::size_t>(index)]; }
    const Texture& depth() const { return depth_; }
    bool has(int index) const { // a texture, not `none`
        return index < count() && format(index) != Format::none;
    }
    Format format(int index) const { return formats_[static_cast<std::size_t>(index)]; }
    int count() const { return static_cast<int>(colours_.size()); }

  private:
    int width_, height_;
    std::vector<Format> formats_;
    std::vector<Texture> colours_;
    Texture depth_;
    Framebuffer framebuffer_;
};

// Draws into a texture that belongs to somebody else, which may be another one each time.
class TextureTarget {
  public:
    TextureTarget() : framebuffer_(GL_NONE) {}
    void bind(const Texture& texture, int width, int height) const; // of a format for colours

  private:
    Framebuffer framebuffer_;
};

// A texture of several levels (each half the size of the one before, rounded down, at least 1) and
// layers, drawn into one slice at a time; with more than one layer it is an array texture. `linear`
// filters when it is read by coordinate.
struct Slices {
    int levels = 1, layers = 1;
    bool linear = false;
};
class SlicedTarget {
  public:
    SlicedTarget(int width, int height, Format format, Slices slices, const std::string& label);

    // From now on this slice is drawn into, with a viewport of its size. Shaders then see the level
    // before it as level 0, so that a level can be made from the one before; after readAll() they
    // see all levels again.
    void bind(int level, int layer) const;
    void readAll() const;
    void clear() const;             // the slice that is bound, to zero
    void bindImage(int unit) const; // for a compute shader to write level 0

    int width(int level = 0) const;
    int height(int level = 0) const;
    const Texture& texture() const { return texture_; }
    Format format() const { return format_; }
    const Slices& slices() const { return slices_; }

  private:
    int width_, height_;
    Format format_;
    Slices slices_;
    Texture texture_;
    Framebuffer framebuffer_;
};

} // namespace obscura::gl
