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

// For each cube, or run of 2, 4, 8 or 16 along `axis`, which of the sixteen lines along that axis
// through it meet a part.
struct Lines {
    int axis;
    glm::ivec3 size; // runs along `axis`, cubes along the others
    std::vector<std::uint16_t> met;
};

std::uint16_t linesOf(std::uint64_t bits, int axis) {
    if (axis == 0) { // bits 0, 4, 8 ... 60 are left, and moved together
        bits = (bits | bits >> 1 | bits >> 2 | bits >> 3) & 0x1111111111111111u;
        bits = (bits | bits >> 3) & 0x0303030303030303u;
        bits = (bits | bits >> 6) & 0x000f000f000f000fu;
        bits = (bits | bits >> 12) & 0x000000ff000000ffu;
        bits |= bits >> 24;
    } else if (axis == 1) { // bits 0 to 3 of each 16
        bits = (bits | bits >> 4 | bits >> 8 | bits >> 12) & 0x000f000f000f000fu;
        bits = (bits | bits >> 12) & 0x000000ff000000ffu;
        bits |= bits >> 24;
    } else {
        bits |= bits >> 16 | bits >> 32 | bits >> 48;
    }
    return static_cast<std::uint16_t>(bits & 0xffffu);
}

Lines linesThrough(const Parts& grid, glm::ivec3 size, int axis) {
    Lines lines{axis, size, std::vector<std::uint16_t>(at(size, 0, 0, size.z))};
    forEachInParallel(size.z, [&](int z) {
        for (std::size_t i = at(size, 0, 0, z); i < at(size, 0, 0, z + 1); ++i)
            if (const std::uint64_t bits = grid[i])
                lines.met[i] = linesOf(bits, axis);
    });
    return lines;
}

Lines runsOfTwice(const Lines& lines) {
    glm::ivec3 size = lines.size;
    size[lines.axis] /= 2;
    Lines longer{lines.axis, size, std::vector<std::uint16_t>(at(size, 0, 0, size.z))};
    const glm::ivec3 fine = lines.size;
    const std::size_t next = lines.axis == 0   ? 1
                             : lines.axis == 1 ? at(fine, 0, 1, 0)
                                               : at(fine, 0, 0, 1);
    forEachInParallel(size.z, [&](int z) {
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                glm::ivec3 first(x, y, z);
                first[lines.axis] *= 2;
                const std::size_t i = at(fine, first.x, first.y, first.z);
                longer.met[at(size, x, y, z)] =
                    static_cast<std::uint16_t>(lines.met[i] | lines.met[i + next]);
            }
    });
    return longer;
}

// Of a cube, by the runs of which it consists, `side` along each of the other axes.
std::uint8_t opacity(const Lines& runs, glm::ivec3 cube, int side) {
    glm::ivec3 low = cube * side, high = low + side;
    low[runs.axis] = cube[runs.axis];
    high[runs.axis] = low[runs.axis] + 1;
    int met = 0;
    for (int z = low.z; z < high.z; ++z)
        for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x)
                met += std::popcount(runs.met[at(runs.size, x, y, z)]);
    const int all = 16 * side * side;
    return static_cast<std::uint8_t>((met * 255 + all / 2) / all);
}

void addOpacities(VoxelGrid& grid, Lines lines) {
    int side = 1;
    for (VoxelGrid::Level& level : grid.levels) {
        if (side > 1)
            lines = runsOfTwice(lines);
        forEachInParallel(level.size.z, [&](int z) {
            for (int y = 0; y < level.size.y; ++y)
                for (int x = 0; x < level.size.x; ++x)
                    level.opacity[4 * at(level.size, x, y, z) +
                                  static_cast<std::size_t>(lines.axis)] =
                        opacity(lines, {x, y, z}, side);
        });
        side *= 2;
    }
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
    for (int level = 0; level < levelCount; ++level, size /= 2)
        grid.levels.push_back({size, std::vector<std::uint8_t>(4 * at(size, 0, 0, size.z))});
    for (int axis = 0; axis < 3; ++axis)
        addOpacities(grid, linesThrough(marked, grid.levels[0].size, axis));
    return grid;
}

} // namespace obscura
