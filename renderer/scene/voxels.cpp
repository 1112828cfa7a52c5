#include "renderer/scene/voxels.h"

#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

namespace obscura {

namespace {

constexpr int parts = 4;                                        // of a cube, along each axis
constexpr int levelCount = 5, coarsest = 1 << (levelCount - 1); // in cubes of level 0

std::size_t at(glm::ivec3 size, int x, int y, int z) {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size.y) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size.x) +
           static_cast<std::size_t>(x);
}

// One bit for each part of each cube: part (x, y, z) is bit x + 4 y + 16 z.
class Parts {
  public:
    explicit Parts(glm::ivec3 cubes)
        : cubes_(cubes),
          bits_(static_cast<std::size_t>(cubes.x) * static_cast<std::size_t>(cubes.y) *
                static_cast<std::size_t>(cubes.z)) {}
    void set(glm::ivec3 part) {
        const glm::ivec3 cube = part / parts, in = part % parts;
        std::atomic_ref<std::uint64_t> bits(bits_[at(cubes_, cube.x, cube.y, cube.z)]);
        const std::uint64_t bit = std::uint64_t{1} << (in.x + 4 * in.y + 16 * in.z);
        if ((bits.load(std::memory_order_relaxed) & bit) == 0)
            bits.fetch_or(bit, std::memory_order_relaxed);
    }
    std::uint64_t operator[](std::size_t cube) const { return bits_[cube]; }

  private:
    glm::ivec3 cubes_;
    std::vector<std::uint64_t> bits_;
};

float drawn(glm::ivec3 place) { // 0 ... 1, by Jarzynski and Olano 2020, "pcg"
    std::uint32_t state = static_cast<std::uint32_t>(place.x) * 747796405u +
                          static_cast<std::uint32_t>(place.y) * 2891336453u +
                          static_cast<std::uint32_t>(place.z) * 277803737u;
    state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return static_cast<float>(((state >> 22u) ^ state) >> 8) / 16777216.0f;
}

// A triangle over the grid of parts, whose unit is a part: where its box meets the columns along
// the axis that it faces most, and how deep its plane is in them.
void mark(Parts& grid, const Occluder& triangle, glm::vec3 origin, float part) {
    const glm::vec3 corners[3] = {(glm::vec3(triangle.a) - origin) / part,
                                  (glm::vec3(triangle.b) - origin) / part,
                                  (glm::vec3(triangle.c) - origin) / part};
    const glm::vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const glm::vec3 facing = glm::abs(normal);
    const int deep = facing.x >= facing.y && facing.x >= facing.z ? 0
                     : facing.y >= facing.z                       ? 1
                                                                  : 2;
    const int u = (deep + 1) % 3, v = (deep + 2) % 3;
    if (facing[deep] <= 0)
        return;
    const glm::vec3 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
    const glm::vec3 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
    // The edges' half-planes over (u, v), inside at 0 and above at the square's innermost corner.
    glm::vec3 edges[3];
    const float turn = normal[deep] > 0 ? 1.0f : -1.0f;
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 from = corners[i], along = corners[(i + 1) % 3] - from;
        const float across = -turn * along[v], up = turn * along[u];
        edges[i] = {across, up,
                    -across * from[u] - up * from[v] + std::max(across, 0.0f) + std::max(up, 0.0f)};
    }
    const float slopeU = -normal[u] / normal[deep], slopeV = -normal[v] / normal[deep];
    const float reach = (std::abs(slopeU) + std::abs(slopeV)) / 2;
    glm::ivec3 place;
    for (place[v] = static_cast<int>(low[v]); place[v] <= static_cast<int>(high[v]); ++place[v])
        for (place[u] = static_cast<int>(low[u]); place[u] <= static_cast<int>(high[u]);
             ++place[u]) {
            const glm::vec3 square(place[u], place[v], 1);
            if (glm::dot(edges[0], square) < 0 || glm::dot(edges[1], square) < 0 ||
                glm::dot(edges[2], square) < 0)
                continue;
            const float middle = corners[0][deep] + slopeU * (square.x + 0.5f - corners[0][u]) +
                                 slopeV * (square.y + 0.5f - corners[0][v]);
            const int last = static_cast<int>(std::min(middle + reach, high[deep]));
            for (place[deep] = static_cast<int>(std::max(middle - reach, low[deep]));
                 place[deep] <= last; ++place[deep])
                if (triangle.a.w >= 1 || drawn(place) < triangle.a.w)
                    grid.set(place);
        }
}

// Of the sixteen lines through a cube along each axis, those that meet a part.
void setOpacity(std::uint8_t* opacity, std::uint64_t bits) {
    const auto share = [](std::uint64_t lines) {
        return static_cast<std::uint8_t>((std::popcount(lines) * 255 + 8) / 16);
    };
    opacity[0] = share((bits | bits >> 1 | bits >> 2 | bits >> 3) & 0x1111111111111111u);
    opacity[1] = share((bits | bits >> 4 | bits >> 8 | bits >> 12) & 0x000f000f000f000fu);
    opacity[2] = share((bits | bits >> 16 | bits >> 32 | bits >> 48) & 0xffffu);
}

VoxelGrid::Level firstLevel(const Parts& grid, glm::ivec3 size) {
    VoxelGrid::Level level{size, {}};
    level.opacity.resize(at(size, 0, 0, size.z) * 4);
    forEachInParallel(size.z, [&](int z) {
        for (std::size_t i = at(size, 0, 0, z); i < at(size, 0, 0, z + 1); ++i)
            if (const std::uint64_t bits = grid[i])
                setOpacity(&level.opacity[4 * i], bits);
    });
    return level;
}

VoxelGrid::Level coarser(const VoxelGrid::Level& fine) {
    VoxelGrid::Level level{fine.size / 2, {}};
    level.opacity.resize(at(level.size, 0, 0, level.size.z) * 4);
    const auto composite = [&](glm::ivec3 low, int axis) {
        int sum = 0; // of 255 x 255 x four lines
        for (int line = 0; line < 4; ++line) {
            int open = 1;
            for (int along = 0; along < 2; ++along) {
                glm::ivec3 place = low;
                place[axis] += along;
                place[(axis + 1) % 3] += line & 1;
                place[(axis + 2) % 3] += line >> 1;
                open *= 255 - fine.opacity[4 * at(fine.size, place.x, place.y, place.z) +
                                           static_cast<std::size_t>(axis)];
            }
            sum += 255 * 255 - open;
        }
        return static_cast<std::uint8_t>((sum + 2 * 255) / (4 * 255));
    };
    forEachInParallel(level.size.z, [&](int z) {
        for (int y = 0; y < level.size.y; ++y)
            for (int x = 0; x < level.size.x; ++x)
                for (int axis = 0; axis < 3; ++axis)
                    level.opacity[4 * at(level.size, x, y, z) + static_cast<std::size_t>(axis)] =
                        composite(2 * glm::ivec3(x, y, z), axis);
    });
    return level;
}

} // namespace

VoxelGrid voxelise(std::span<const Occluder> triangles, float side) {
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const Occluder& triangle : triangles)
        for (const glm::vec4& corner : {triangle.a, triangle.b, triangle.c}) {
            low = glm::min(low, glm::vec3(corner));
            high = glm::max(high, glm::vec3(corner));
        }
    if (triangles.empty())
        low = high = glm::vec3(0);
    VoxelGrid grid;
    glm::ivec3 size;
    for (grid.side = side;; grid.side *= 2) {
        // Round coordinates, as walls have, then lie within parts and not between them.
        grid.origin = low - 0.57f * grid.side;
        const glm::vec3 cubes = glm::ceil((high - grid.origin) / (coarsest * grid.side) + 0.01f);
        if (coarsest * coarsest * coarsest * cubes.x * cubes.y * cubes.z <=
            static_cast<float>(mostVoxels)) {
            size = coarsest * glm::ivec3(cubes);
            break;
        }
    }
    Parts marked(size);
    forEachInParallel(triangles.size(), [&](std::size_t i) {
        mark(marked, triangles[i], grid.origin, grid.side / parts);
    });
    grid.levels.push_back(firstLevel(marked, size));
    while (grid.levels.size() < levelCount)
        grid.levels.push_back(coarser(grid.levels.back()));
    return grid;
}

} // namespace obscura
