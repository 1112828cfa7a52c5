#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace obscura::gl {

// Owns one OpenGL object: made by the constructor, destroyed by the destructor, moved but never
// copied. The context must be current for both. Made through direct state access (OpenGL 4.5).
template <typename Traits>
class Object {
  public:
    Object() = default; // owns nothing
    template <typename... Arguments>
    explicit Object(GLenum first, Arguments... rest) : name_(Traits::create(first, rest...)) {}
    ~Object() {
        if (name_)
            Traits::destroy(name_);
    }
    Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }

    GLuint name() const { return name_; }
    // Owns it no longer: it lives until the last context that shares it is gone.
    void release() { name_ = 0; }
    explicit operator bool() const { return name_ != 0; }

  private:
    GLuint name_ = 0;
};

// clang-format off
struct TextureTraits {
    static GLuint create(GLenum target) { GLuint name = 0; glCreateTextures(target, 1, &name); return name; }
    static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct BufferTraits {
    static GLuint create(GLenum) { GLuint name = 0; glCreateBuffers(1, &name); return name; }
    static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct FramebufferTraits {
    static GLuint create(GLenum) { GLuint name = 0; glCreateFramebuffers(1, &name); return name; }
    static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct VertexArrayTraits {
    static GLuint create(GLenum) { GLuint name = 0; glCreateVertexArrays(1, &name); return name; }
    static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct ProgramTraits {
    static GLuint create(GLenum) { return glCreateProgram(); }
    static void destroy(GLuint name) { glDeleteProgram(name); }
};
struct ShaderTraits {
    static GLuint create(GLenum stage) { return glCreateShader(stage); }
    static void destroy(GLuint name) { glDeleteShader(name); }
};
struct QueryTraits {
    static GLuint create(GLenum target) { GLuint name = 0; glCreateQueries(target, 1, &name); return name; }
    static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};
// clang-format on

// The argument is the target (textures: GL_TEXTURE_2D, ...), the stage (shaders), what is asked
// (queries: GL_TIMESTAMP), else GL_NONE.
using Texture = Object<TextureTraits>;
using Buffer = Object<BufferTraits>;
using Framebuffer = Object<FramebufferTraits>;
using VertexArray = Object<VertexArrayTraits>;
using ProgramObject = Object<ProgramTraits>;
using ShaderObject = Object<ShaderTraits>;
using QueryObject = Object<QueryTraits>;

} // namespace obscura::gl
