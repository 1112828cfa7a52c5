#pragma once

#include "gl/draw.h"
#include "gl/target.h"
#include "renderer/scene/occluders.h"
#include "renderer/scene/voxels.h"

#include <optional>

namespace obscura {

// A scene's triangles where shaders can read them: `Occluder occluders[]`.
class OccluderBuffer {
  public:
    explicit OccluderBuffer(std::span<const Occluder> occluders);
    int count() const { return count_; }
    void bind(int binding) const { buffer_.bind(binding); }

  private:
    int count_;
    gl::UniformBuffer buffer_;
};

// A scene's voxels (renderer/scene/voxels.h) where shaders can read them: a texture, and a block of
// what lies where: xyz the grid's low corner, w the side of a voxel (metres); xyz 1 / the grid's
// extent.
class VoxelTexture {
  public:
    VoxelTexture(std::span<const Occluder> occluders, float side);
    void bind(int unit, int binding) const;

  private:
    explicit VoxelTexture(const VoxelGrid& grid);

    gl::Texture texture_;
    gl::UniformBuffer place_;
};

// What techniques that work on objects read of a scene; each made when it is first asked for.
class SceneOccluders {
  public:
    explicit SceneOccluders(const Scene& scene) : occluders_(obscura::occluders(scene)) {}

    const OccluderBuffer& triangles() const;
    // Voxels with this side (metres) or, in scenes too large for that, a multiple of it. They are
    // kept until another side is asked for.
    const VoxelTexture& voxels(float side) const;

  private:
    std::vector<Occluder> occluders_;
    mutable std::optional<OccluderBuffer> triangles_;
    mutable std::optional<VoxelTexture> voxels_;
    mutable float side_ = 0;
};

} // namespace obscura
