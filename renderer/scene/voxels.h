#pragma once

#include "renderer/scene/occluders.h"

#include <cstdint>
#include <span>

namespace obscura {

// How opaque each cube of a grid is, and each cube of 2, 4, 8 and 16 times the side: the share of
// lines along x (first byte), y and z (second, third) through it that meet a surface, 0 ... 255.
// The fourth byte is unused.
struct VoxelGrid {
    struct Level {
        glm::ivec3 size{0}; // cubes along x, y, z; x runs fastest in `opacity`
        std::vector<std::uint8_t> opacity;
    };
    glm::vec3 origin{0};       // world space, the grid's low corner
    float side = 0;            // of a cube of level 0, metres
    std::vector<Level> levels; // of which each size is half that of the one before
};

// Surfaces voxelised conservatively, as by Schwarz and Seidel 2010, "Fast parallel surface and
// solid voxelization on GPUs": of the 4 x 4 x 4 parts of a cube, each counts as met unless the
// triangle's outline, seen along the axis that it faces most, or its plane's depth along that axis
// clears it. Where a triangle is covered in part, that share of its parts counts, drawn by their
// places. A grid of more than `mostVoxels` has its side doubled until it has not. The same
// triangles give the same grid.
constexpr std::int64_t mostVoxels = std::int64_t{1} << 25;
VoxelGrid voxelise(std::span<const Occluder> triangles, float side);

} // namespace obscura
