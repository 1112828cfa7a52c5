#pragma once

#include "renderer/scene/gltf_file.h"

#include <tiny_gltf.h>

#include <cstdint>
#include <unordered_map>

namespace obscura {

// The elements of one accessor of a checked file, read one at a time, so that nothing is allocated
// for a count that only a few triangles use. Sparse accessors give their replaced elements; those
// without a buffer view give zeros.
class GltfAccessor {
  public:
    GltfAccessor(const GltfFile& file, const tinygltf::Model& model, int index);
    // Of floats that lie elsewhere, and stay there.
    GltfAccessor(std::span<const float> values, int components);

    std::size_t count() const { return count_; }
    int components() const { return components_; } // 1 ... 4 for what meshes read
    int componentType() const { return type_; }    // TINYGLTF_COMPONENT_TYPE_...
    // Reads whole numbers as shares of the greatest one, whatever the file says.
    void normalise() { normalised_ = true; }

    // A component as a number, normalised integers expanded.
    float value(std::size_t element, int component) const;
    // The first component of an unsigned whole number.
    std::uint32_t whole(std::size_t element) const;

  private:
    const std::byte* element(std::size_t index) const;

    const std::byte* first_ = nullptr; // null: zeros
    std::size_t count_ = 0, stride_ = 0;
    int components_ = 0, type_ = 0;
    bool normalised_ = false;
    std::unordered_map<std::size_t, const std::byte*> replaced_;
};

} // namespace obscura
