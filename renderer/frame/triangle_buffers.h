#pragma once

#include "gl/draw.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace obscura {

// A scene's triangles for shaders to trace (shaders/tree.glsl): a binary tree of boxes in the order
// in which a ray visits them, depth first, so that no stack is needed.
struct TriangleTree {
    // Two for each box. First the least corner, as bits of floats, and where to go on when the ray
    // misses the box; then the greatest corner and, of a leaf, 8 x its first triangle + their
    // number. Of other boxes that is 0, and the next node is the first child.
    std::vector<glm::uvec4> nodes;
    // Three for each triangle: its corners, world space. In w of the first, where the triangle's
    // mask begins in `masks`, or -1.
    std::vector<glm::vec4> triangles;
    // Of a masked triangle, twelve words: u, v and alpha of each corner, the cutoff, where the map
    // begins or 0 where there is none, and 0. Of a map, width, height, how it is read (wrap of u +
    // 4 x wrap of v + 16 x nearest, in the order of Wrap), and its alphas, four in a word.
    std::vector<std::uint32_t> masks;
};

class TriangleBuffers {
  public:
    explicit TriangleBuffers(const TriangleTree& tree);
    // The three at successive binding points.
    void bind(int binding) const;

  private:
    gl::UniformBuffer nodes_, triangles_, masks_;
};

} // namespace obscura
