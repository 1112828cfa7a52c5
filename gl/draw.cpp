#include "gl/draw.h"

#include <numeric>

namespace obscura::gl {

namespace {

void enable(GLenum capability, bool on) { (on ? glEnable : glDisable)(capability); }

} // namespace

void State::apply() const {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    enable(GL_DEPTH_TEST, depth != Depth::off);
    glDepthMask(depth == Depth::reversed || depth == Depth::forward);
    glDepthFunc(depth == Depth::reversed  ? GL_GREATER
                : depth == Depth::forward ? GL_LESS
                                          : GL_EQUAL);
    const GLboolean write = colour ? GL_TRUE : GL_FALSE;
    glColorMask(write, write, write, write);
    enable(GL_CULL_FACE, cullBack);
    enable(GL_BLEND, add);
    glBlendFunc(GL_ONE, GL_ONE);
    enable(GL_POLYGON_OFFSET_FILL, slopeBias != 0 || constantBias != 0);
    glPolygonOffset(slopeBias, constantBias);
}

Geometry::Geometry(std::span<const std::byte> vertices, std::span<const int> attributeFloats,
                   std::span<const std::uint32_t> indices)
    : array_(GL_NONE), vertices_(GL_NONE), indices_(GL_NONE) {
    glNamedBufferStorage(vertices_.name(), static_cast<GLsizeiptr>(vertices.size_bytes()),
                         vertices.data(), 0);
    glNamedBufferStorage(indices_.name(), static_cast<GLsizeiptr>(indices.size_bytes()),
                         indices.data(), 0);
    const int stride = std::accumulate(attributeFloats.begin(), attributeFloats.end(), 0) * 4;
    glVertexArrayVertexBuffer(array_.name(), 0, vertices_.name(), 0, stride);
    glVertexArrayElementBuffer(array_.name(), indices_.name());
    GLuint offset = 0;
    for (std::size_t i = 0; i < attributeFloats.size(); ++i) {
        const auto location = static_cast<GLuint>(i);
        glEnableVertexArrayAttrib(array_.name(), location);
        glVertexArrayAttribFormat(array_.name(), location, attributeFloats[i], GL_FLOAT, GL_FALSE,
                                  offset);
        glVertexArrayAttribBinding(array_.name(), location, 0);
        offset += static_cast<GLuint>(attributeFloats[i]) * 4;
    }
}

void Geometry::bind() const { glBindVertexArray(array_.name()); }

void Geometry::draw(std::uint32_t firstIndex, std::uint32_t count) const {
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(static_cast<std::uintptr_t>(firstIndex) * 4));
}

UniformBuffer::UniformBuffer(std::span<const std::byte> content, Kind kind)
    : buffer_(GL_NONE), kind_(kind) {
    glNamedBufferStorage(buffer_.name(), static_cast<GLsizeiptr>(content.size()), content.data(),
                         0);
}

void UniformBuffer::bind(int binding) const {
    glBindBufferBase(kind_ == Kind::uniform ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER,
                     static_cast<GLuint>(binding), buffer_.name());
}

void ScreenTriangle::draw() const {
    glBindVertexArray(array_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void ScreenTriangle::drawQuads(int count) const {
    glBindVertexArray(array_.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

void ScreenTriangle::drawBoxes(int count) const {
    glBindVertexArray(array_.name());
    glDrawArrays(GL_TRIANGLES, 0, 36 * count);
}

void compute(int groupsX, int groupsY) {
    glDispatchCompute(static_cast<GLuint>(groupsX), static_cast<GLuint>(groupsY), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                    GL_FRAMEBUFFER_BARRIER_BIT);
}

void finish() { glFinish(); }

} // namespace obscura::gl
