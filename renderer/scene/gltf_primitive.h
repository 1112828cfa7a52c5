#pragma once

#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/gltf_draco.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// One primitive of a checked file: its accessors and triangles, out of its Draco stream where it
// has one (KHR_draco_mesh_compression). Cheap to copy.
class GltfPrimitive {
  public:
    // `mostCorners` is the most that may be made of a Draco stream.
    GltfPrimitive(const GltfFile& file, const tinygltf::Model& model, int mesh, std::size_t index,
                  std::size_t mostCorners);

    const std::string& at() const { return at_; } // its JSON path
    int material() const { return from_->material; }
    bool isTriangles() const; // not points or lines
    bool has(const std::string& attribute) const { return from_->attributes.contains(attribute); }
    std::size_t targets() const { return from_->targets.size(); }

    // With the components that meshes may have there, and as many elements as POSITION; null where
    // the primitive, or that morph target of it, lacks the attribute.
    std::optional<GltfAccessor> attribute(const std::string& name) const;
    std::optional<GltfAccessor> targetAttribute(std::size_t target, const std::string& name) const;
    std::size_t vertices() const { return vertices_; }

    // Which vertices the triangles have, three each; strips and fans are taken apart. An Error
    // where there are more than `most`.
    std::vector<std::uint32_t> corners(std::size_t most) const;

  private:
    void unpack(const nlohmann::json& primitive, std::size_t mostCorners);
    GltfAccessor checked(GltfAccessor accessor, int index, const std::string& name,
                         const std::string& at) const;
    std::vector<std::uint32_t> order(std::size_t most) const;
    std::vector<std::uint32_t> triangles(std::vector<std::uint32_t> order, std::size_t most) const;
    void limit(std::size_t corners, std::size_t most) const;

    const GltfFile* file_;
    const tinygltf::Model* model_;
    const tinygltf::Primitive* from_;
    std::string at_;
    std::shared_ptr<const DracoMesh> draco_;
    std::size_t vertices_ = 0;
};

} // namespace obscura
