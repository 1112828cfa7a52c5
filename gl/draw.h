#pragma once

#include "gl/object.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace obscura::gl {

// Fixed-function state of a pass; apply() sets all of it, so no pass depends on the one before.
struct State {
    // `reversed` is for cameras: depth is 1 near and 0 infinitely far, and the greater one passes.
    // `forward` is for the sun: the smaller one passes. `equal` draws only what an earlier pass
    // found nearest, and leaves the depth as it is.
    enum class Depth { off, reversed, forward, equal } depth = Depth::off;
    bool colour = true; // draw into the colour targets too
    bool cullBack = false;
    bool add = false;                      // blend: add to what is there
    float slopeBias = 0, constantBias = 0; // polygon offset

    void apply() const;
};

// Interleaved float attributes: the number of floats of each, locations 0, 1, 2, ...
class Geometry {
  public:
    Geometry(std::span<const std::byte> vertices, std::span<const int> attributeFloats,
             std::span<const std::uint32_t> indices);

    void bind() const;
    void draw(std::uint32_t firstIndex, std::uint32_t count) const; // bound before

  private:
    VertexArray array_;
    Buffer vertices_, indices_;
};

// A buffer that shaders read at a binding point.
class UniformBuffer {
  public:
    enum class Kind { uniform, storage };
    explicit UniformBuffer(std::span<const std::byte> content, Kind kind = Kind::uniform);
    void bind(int binding) const;

  private:
    Buffer buffer_;
    Kind kind_;
};

// What needs no vertex data: the shader makes its corners from gl_VertexID.
class ScreenTriangle {
  public:
    ScreenTriangle() : array_(GL_NONE) {}
    void draw() const; // one triangle that covers the bound target (shaders/screen.vert)
    void drawQuads(int count) const; // one quad per gl_InstanceID (shaders/splat.vert)
    void drawBoxes(int count) const; // 36 vertices each (shaders/box.vert)

  private:
    VertexArray array_;
};

// Runs the bound compute shader; what it writes can be sampled, drawn over and read back after.
void compute(int groupsX, int groupsY);

void finish(); // waits until everything issued is done

} // namespace obscura::gl
