#include "gl/screen.h"

#include "gl/target.h"

#include <epoxy/gl.h>

namespace obscura::gl {

void clearScreen(int width, int height, std::array<float, 3> colour) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(colour[0], colour[1], colour[2], 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

std::vector<std::uint8_t> readScreen(int width, int height) {
    std::vector<std::uint8_t> pixels(3 * static_cast<std::size_t>(width) *
                                     static_cast<std::size_t>(height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadBuffer(GL_BACK);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    return pixels;
}

Texture uploaded(int width, int height, std::span<const std::byte> rgba) {
    Texture texture = targetTexture(width, height, Format::rgba8, "uploaded");
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                        rgba.data());
    return texture;
}

} // namespace obscura::gl
