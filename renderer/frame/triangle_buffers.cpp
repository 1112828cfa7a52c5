#include "renderer/frame/triangle_buffers.h"

namespace obscura {

namespace {

template <typename T>
gl::UniformBuffer uploaded(const std::vector<T>& values) {
    static const std::vector<T> nothing(1); // because a buffer must not be empty
    return gl::UniformBuffer(std::as_bytes(std::span(values.empty() ? nothing : values)),
                             gl::UniformBuffer::Kind::storage);
}

} // namespace

TriangleBuffers::TriangleBuffers(const TriangleTree& tree)
    : nodes_(uploaded(tree.nodes)), triangles_(uploaded(tree.triangles)),
      masks_(uploaded(tree.masks)) {}

void TriangleBuffers::bind(int binding) const {
    nodes_.bind(binding);
    triangles_.bind(binding + 1);
    masks_.bind(binding + 2);
}

} // namespace obscura
