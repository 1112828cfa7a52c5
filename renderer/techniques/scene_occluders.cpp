#include "renderer/techniques/scene_occluders.h"

namespace obscura {

namespace {

constexpr Occluder noOccluder[] = {{glm::vec4(0), glm::vec4(0), glm::vec4(0)}}; // for empty buffers

gl::Texture textureOf(const VoxelGrid& grid) {
    std::vector<gl::VolumeLevel> levels;
    for (const VoxelGrid::Level& level : grid.levels)
        levels.push_back({level.size.x, level.size.y, level.size.z, level.opacity});
    return gl::volumeTexture(levels);
}

gl::UniformBuffer placeOf(const VoxelGrid& grid) {
    const glm::vec3 extent = grid.side * glm::vec3(grid.levels[0].size);
    const glm::vec4 place[] = {glm::vec4(grid.origin, grid.side), glm::vec4(1.0f / extent, 0)};
    return gl::UniformBuffer(std::as_bytes(std::span(place)));
}

} // namespace

OccluderBuffer::OccluderBuffer(std::span<const Occluder> occluders)
    : count_(static_cast<int>(occluders.size())),
      buffer_(std::as_bytes(occluders.empty() ? noOccluder : occluders),
              gl::UniformBuffer::Kind::storage) {}

VoxelTexture::VoxelTexture(std::span<const Occluder> occluders, float side)
    : VoxelTexture(voxelise(occluders, side)) {}

VoxelTexture::VoxelTexture(const VoxelGrid& grid)
    : texture_(textureOf(grid)), place_(placeOf(grid)) {}

void VoxelTexture::bind(int unit, int binding) const {
    gl::bindTexture(unit, texture_);
    place_.bind(binding);
}

const OccluderBuffer& SceneOccluders::triangles() const {
    if (!triangles_)
        triangles_.emplace(occluders_);
    return *triangles_;
}

const VoxelTexture& SceneOccluders::voxels(float side) const {
    if (!voxels_ || side != side_) {
        voxels_.reset(); // its memory goes before the other's comes
        voxels_.emplace(occluders_, side);
        side_ = side;
    }
    return *voxels_;
}

} // namespace obscura
