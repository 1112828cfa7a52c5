#include "gl/target.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>

namespace obscura::gl {

namespace {

struct Layout {
    GLenum internal, external, type; // how it is stored, and read back without conversion
    int channels, bytes;             // per pixel
};

Layout layoutOf(Format format) {
    switch (format) {
    case Format::none:
        return {GL_NONE, GL_NONE, GL_NONE, 0, 0};
    case Format::r8:
        return {GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1, 1};
    case Format::r16f:
        return {GL_R16F, GL_RED, GL_HALF_FLOAT, 1, 2};
    case Format::r32f:
        return {GL_R32F, GL_RED, GL_FLOAT, 1, 4};
    case Format::rg16f:
        return {GL_RG16F, GL_RG, GL_HALF_FLOAT, 2, 4};
    case Format::rg32f:
        return {GL_RG32F, GL_RG, GL_FLOAT, 2, 8};
    case Format::rgba8:
        return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 4};
    case Format::srgb8:
        return {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4, 4};
    case Format::rgba16f:
        return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 4, 8};
    case Format::rgba32f:
        return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, 16};
    case Format::depth32f:
        break;
    }
    return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 1, 4};
}

void setParameter(const Texture& texture, GLenum name, GLint value) {
    glTextureParameteri(texture.name(), name, value);
}

} // namespace

int channelsOf(Format format) { return layoutOf(format).channels; }
int bytesOf(Format format) { return layoutOf(format).bytes; }

const char* glslName(Format format) {
    switch (format) {
    case Format::r8:
        return "r8";
    case Format::r16f:
        return "r16f";
    case Format::r32f:
        return "r32f";
    case Format::rg16f:
        return "rg16f";
    case Format::rg32f:
        return "rg32f";
    case Format::rgba8:
        return "rgba8";
    case Format::rgba16f:
        return "rgba16f";
    case Format::rgba32f:
        return "rgba32f";
    default:
        assert(false && "images have no such format");
        return "";
    }
}

Texture targetTexture(int width, int height, Format format, const std::string& label) {
    Texture texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.name(), 1, layoutOf(format).internal, width, height);
    glObjectLabel(GL_TEXTURE, texture.name(), -1, label.c_str());
    const bool depth = format == Format::depth32f;
    setParameter(texture, GL_TEXTURE_MIN_FILTER, depth ? GL_LINEAR : GL_NEAREST);
    setParameter(texture, GL_TEXTURE_MAG_FILTER, depth ? GL_LINEAR : GL_NEAREST);
    setParameter(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    setParameter(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    if (depth)
        setParameter(texture, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    return texture;
}

namespace {

GLint modeOf(Wrap wrap) {
    switch (wrap) {
    case Wrap::mirrored:
        return GL_MIRRORED_REPEAT;
    case Wrap::clamp:
        return GL_CLAMP_TO_EDGE;
    default:
        return GL_REPEAT;
    }
}

GLint modeOf(Minified minified) {
    constexpr GLint modes[] = {GL_NEAREST,
                               GL_LINEAR,
                               GL_NEAREST_MIPMAP_NEAREST,
                               GL_LINEAR_MIPMAP_NEAREST,
                               GL_NEAREST_MIPMAP_LINEAR,
                               GL_LINEAR_MIPMAP_LINEAR};
    return modes[static_cast<std::size_t>(minified)];
}

} // namespace

bool isAnisotropic(bool srgb, Sampling sampling) {
    return srgb && sampling.minified == Minified::linearMipmapLinear;
}

Texture imageTexture(int width, int height, bool srgb, std::span<const std::uint8_t> rgba,
                     Sampling sampling) {
    Texture texture(GL_TEXTURE_2D);
    const bool mipmaps = sampling.minified > Minified::linear;
    const int levels = mipmaps ? std::bit_width(static_cast<unsigned>(std::max(width, height))) : 1;
    glTextureStorage2D(texture.name(), levels, srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, width, height);
    glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                        rgba.data());
    if (mipmaps)
        glGenerateTextureMipmap(texture.name());
    setParameter(texture, GL_TEXTURE_MIN_FILTER, modeOf(sampling.minified));
    setParameter(texture, GL_TEXTURE_MAG_FILTER, sampling.nearest ? GL_NEAREST : GL_LINEAR);
    setParameter(texture, GL_TEXTURE_WRAP_S, modeOf(sampling.u));
    setParameter(texture, GL_TEXTURE_WRAP_T, modeOf(sampling.v));
    // Colour only: software drivers take five times as long for it, and blurred relief at grazing
    // angles is not seen.
    if (isAnisotropic(srgb, sampling))
        filterAnisotropically(texture, true);
    return texture;
}

Texture filteredTexture(std::span<const FloatLevel> levels) {
    Texture texture(GL_TEXTURE_2D);
    const auto count = static_cast<GLint>(levels.size());
    glTextureStorage2D(texture.name(), count, GL_RGB32F, levels[0].width, levels[0].height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (GLint i = 0; i < count; ++i) {
        const FloatLevel& level = levels[static_cast<std::size_t>(i)];
        glTextureSubImage2D(texture.name(), i, 0, 0, level.width, level.height, GL_RGB, GL_FLOAT,
                            level.rgb.data());
    }
    setParameter(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    setParameter(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    setParameter(texture, GL_TEXTURE_WRAP_S, GL_REPEAT);
    setParameter(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

Texture volumeTexture(std::span<const VolumeLevel> levels) {
    Texture texture(GL_TEXTURE_3D);
    const auto count = static_cast<GLint>(levels.size());
    glTextureStorage3D(texture.name(), count, GL_RGBA8, levels[0].width, levels[0].height,
                       levels[0].depth);
    for (GLint i = 0; i < count; ++i) {
        const VolumeLevel& level = levels[static_cast<std::size_t>(i)];
        glTextureSubImage3D(texture.name(), i, 0, 0, 0, level.width, level.height, level.depth,
                            GL_RGBA, GL_UNSIGNED_BYTE, level.rgba.data());
    }
    setParameter(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    setParameter(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        setParameter(texture, wrap, GL_CLAMP_TO_BORDER); // whose colour is 0
    return texture;
}

Texture floatTexture(int width, int height, std::span<const float> values) {
    Texture texture = targetTexture(width, height, Format::r32f, "values");
    writeFloats(texture, width, height, values);
    return texture;
}

Texture constantTexture(std::array<float, 4> value) {
    Texture texture = targetTexture(1, 1, Format::rgba32f, "constant");
    glTextureSubImage2D(texture.name(), 0, 0, 0, 1, 1, GL_RGBA, GL_FLOAT, value.data());
    return texture;
}

void filterAnisotropically(const Texture& texture, bool anisotropically) {
    if (!epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
        return;
    GLfloat most = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    glTextureParameterf(texture.name(), GL_TEXTURE_MAX_ANISOTROPY_EXT,
                        anisotropically ? std::min(most, 8.0f) : 1.0f);
}

void bindTexture(int unit, const Texture& texture) {
    glBindTextureUnit(static_cast<GLuint>(unit), texture.name());
}

void filterLinearly(const Texture& texture, bool linearly) {
    setParameter(texture, GL_TEXTURE_MIN_FILTER, linearly ? GL_LINEAR : GL_NEAREST);
    setParameter(texture, GL_TEXTURE_MAG_FILTER, linearly ? GL_LINEAR : GL_NEAREST);
}

std::vector<std::byte> readBytes(const Texture& texture, int width, int height, Format format) {
    const Layout layout = layoutOf(format);
    std::vector<std::byte> bytes(static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height) *
                                 static_cast<std::size_t>(layout.bytes));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture.name(), 0, layout.external, layout.type,
                      static_cast<GLsizei>(bytes.size()), bytes.data());
    return bytes;
}

std::vector<float> readFloats(const Texture& texture, int width, int height, Format format) {
    const Layout layout = layoutOf(format);
    std::vector<float> values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                              static_cast<std::size_t>(layout.channels));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture.name(), 0, layout.external, GL_FLOAT,
                      static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
    return values;
}

std::array<float, 4> readTexel(const Texture& texture, int x, int y) {
    std::array<float, 4> value{};
    glGetTextureSubImage(texture.name(), 0, x, y, 0, 1, 1, 1, GL_RGBA, GL_FLOAT, sizeof value,
                         value.data());
    return value;
}

void writeFloats(const Texture& texture, int width, int height, std::span<const float> values) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RED, GL_FLOAT, values.data());
}

Target::Target(int width, int height, std::span<const Format> colours, bool depth,
               const std::string& label)
    : width_(width), height_(height), formats_(colours.begin(), colours.end()),
      framebuffer_(GL_NONE) {
    std::vector<GLenum> attachments;
    for (const Format format : formats_) {
        attachments.push_back(format == Format::none
                                  ? GL_NONE
                                  : GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(colours_.size()));
        if (format == Format::none) {
            colours_.emplace_back();
            continue;
        }
        colours_.push_back(targetTexture(width, height, format, label));
        glNamedFramebufferTexture(framebuffer_.name(), attachments.back(), colours_.back().name(),
                                  0);
    }
    glNamedFramebufferDrawBuffers(framebuffer_.name(), static_cast<GLsizei>(attachments.size()),
                                  attachments.data());
    if (depth) {
        depth_ = targetTexture(width, height, Format::depth32f, label);
        glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
    }
    const GLenum status = glCheckNamedFramebufferStatus(framebuffer_.name(), GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw Error(fmt::format("the driver refuses a {} x {} target for \"{}\" (status 0x{:x})",
                                width, height, label, status));
}

void Target::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, width_, height_);
    // Encodes what is drawn into srgb8; other formats are not concerned.
    glEnable(GL_FRAMEBUFFER_SRGB);
}

void Target::clear(int colour, std::array<float, 4> value) const {
    glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, colour, value.data());
}

void Target::clearDepth(float value) const {
    glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &value);
}

void TextureTarget::bind(const Texture& texture, int width, int height) const {
    glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, width, height);
}

SlicedTarget::SlicedTarget(int width, int height, Format format, Slices slices,
                           const std::string& label)
    : width_(width), height_(height), format_(format), slices_(slices),
      texture_(slices.layers > 1 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D), framebuffer_(GL_NONE) {
    slices_.levels =
        std::min(slices.levels,
                 static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(width, height)))));
    const GLenum internal = layoutOf(format).internal;
    if (slices.layers > 1)
        glTextureStorage3D(texture_.name(), slices_.levels, internal, width, height, slices.layers);
    else
        glTextureStorage2D(texture_.name(), slices_.levels, internal, width, height);
    glObjectLabel(GL_TEXTURE, texture_.name(), -1, label.c_str());
    const bool mips = slices_.levels > 1;
    setParameter(texture_, GL_TEXTURE_MIN_FILTER,
                 slices.linear ? (mips ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR)
                               : (mips ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST));
    setParameter(texture_, GL_TEXTURE_MAG_FILTER, slices.linear ? GL_LINEAR : GL_NEAREST);
    setParameter(texture_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    setParameter(texture_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void SlicedTarget::bind(int level, int layer) const {
    if (slices_.layers > 1)
        glNamedFramebufferTextureLayer(framebuffer_.name(), GL_COLOR_ATTACHMENT0, texture_.name(),
                                       level, layer);
    else
        glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, texture_.name(),
                                  level);
    if (level > 0) {
        setParameter(texture_, GL_TEXTURE_BASE_LEVEL, level - 1);
        setParameter(texture_, GL_TEXTURE_MAX_LEVEL, level - 1);
    }
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, width(level), height(level));
    glEnable(GL_FRAMEBUFFER_SRGB);
}

void SlicedTarget::readAll() const {
    setParameter(texture_, GL_TEXTURE_BASE_LEVEL, 0);
    setParameter(texture_, GL_TEXTURE_MAX_LEVEL, slices_.levels - 1);
}

void SlicedTarget::clear() const {
    constexpr GLfloat zero[4] = {};
    glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, zero);
}

void SlicedTarget::bindImage(int unit) const {
    glBindImageTexture(static_cast<GLuint>(unit), texture_.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY,
                       layoutOf(format_).internal);
}

int SlicedTarget::width(int level) const { return std::max(width_ >> level, 1); }
int SlicedTarget::height(int level) const { return std::max(height_ >> level, 1); }

} // namespace obscura::gl
