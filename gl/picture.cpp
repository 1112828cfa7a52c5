#include "gl/picture.h"

#include "base/error.h"

#include <fmt/format.h>

#include <cassert>

namespace obscura::gl {

Picture::Picture(int width, int height, int channels, std::span<const std::uint8_t> pixels)
    : width_(width), height_(height), texture_(GL_TEXTURE_2D), framebuffer_(GL_NONE) {
    assert(channels == 3 || channels == 4);
    assert(pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                                static_cast<std::size_t>(channels));
    glTextureStorage2D(texture_.name(), 1, GL_RGBA8, width, height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture_.name(), 0, 0, 0, width, height, channels == 3 ? GL_RGB : GL_RGBA,
                        GL_UNSIGNED_BYTE, pixels.data());
    glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, texture_.name(), 0);
    if (glCheckNamedFramebufferStatus(framebuffer_.name(), GL_READ_FRAMEBUFFER) !=
            GL_FRAMEBUFFER_COMPLETE ||
        glGetError() != GL_NO_ERROR)
        throw Error(fmt::format("an image of {}x{} pixels does not fit into graphics memory", width,
                                height));
}

void Picture::draw(int x, int y, int framebufferHeight) const {
    const int top = framebufferHeight - y; // OpenGL counts rows from the bottom: copy upside down
    glBlitNamedFramebuffer(framebuffer_.name(), 0, 0, 0, width_, height_, x, top, x + width_,
                           top - height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

} // namespace obscura::gl
