#include "renderer/builtin/atlas.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

namespace obscura::builtin {

namespace {

constexpr float margin = 0.003F; // of the atlas, round each patch: 3 texels of 1024

using Triangle = std::array<std::uint32_t, 3>;

Triangle triangleAt(const Shape& shape, std::size_t i) {
    return {shape.indices[3 * i], shape.indices[3 * i + 1], shape.indices[3 * i + 2]};
}

// Normals averaged with their neighbours', so that the borders of patches run smoothly.
std::vector<glm::vec3> calmNormals(const Shape& shape) {
    std::vector<glm::vec3> normals;
    for (const Vertex& vertex : shape.vertices)
        normals.push_back(vertex.normal);
    for (int round = 0; round < 12; ++round) {
        std::vector<glm::vec3> sums = normals;
        for (std::size_t i = 0; i < shape.indices.size(); ++i) {
            const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
            sums[shape.indices[i]] += normals[shape.indices[next]];
        }
        for (std::size_t i = 0; i < normals.size(); ++i)
            normals[i] = glm::length(sums[i]) > 0 ? glm::normalize(sums[i]) : normals[i];
    }
    return normals;
}

// Which way a patch faces: 2 x axis, plus 1 for the negative side.
int facing(glm::vec3 normal) {
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    return 2 * axis + (normal[axis] < 0 ? 1 : 0);
}

glm::vec2 flattened(glm::vec3 p, int facing) {
    const float sign = facing % 2 == 0 ? 1.0F : -1.0F;
    switch (facing / 2) {
    case 0:
        return {-sign * p.z, -p.y};
    case 1:
        return {p.x, sign * p.z};
    default:
        return {sign * p.x, -p.y};
    }
}

// Triangles of one label that hang together.
class Groups {
  public:
    explicit Groups(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    }
    std::size_t find(std::size_t i) {
        while (parents_[i] != i)
            i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) { parents_[find(b)] = find(a); }

  private:
    std::vector<std::size_t> parents_;
};

struct Patch {
    int facing = 0;
    float density = 1;
    std::vector<std::size_t> triangles;
    glm::vec2 low{1e9F}, high{-1e9F}; // on the plane, metres x density
    glm::vec2 corner{0};              // in the atlas, the same
    glm::vec2 size() const { return high - low; }
    glm::vec2 flat(glm::vec3 p) const { return density * flattened(p, facing); }
};

// For each triangle, which one stands for its patch: those that share a label and hang together.
std::vector<std::size_t> patchOfEach(const Shape& shape, const std::vector<int>& labels) {
    Groups groups(labels.size());
    std::unordered_map<std::uint64_t, std::size_t> seen; // a triangle at (vertex, label)
    for (std::size_t i = 0; i < labels.size(); ++i)
        for (const std::uint32_t vertex : triangleAt(shape, i)) {
            const auto key = (std::uint64_t{vertex} << 32U) + static_cast<unsigned>(labels[i]);
            groups.join(seen.try_emplace(key, i).first->second, i);
        }
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < labels.size(); ++i)
        result.push_back(groups.find(i));
    return result;
}

// The tallest first.
std::vector<Patch> patchesOf(const Shape& shape, const std::vector<int>& part,
                             const std::vector<float>& density) {
    const std::vector<glm::vec3> normals = calmNormals(shape);
    std::vector<int> labels;
    for (std::size_t i = 0; i < shape.indices.size() / 3; ++i) {
        const Triangle t = triangleAt(shape, i);
        labels.push_back(facing(normals[t[0]] + normals[t[1]] + normals[t[2]]) + 6 * part[t[0]]);
    }
    const std::vector<std::size_t> roots = patchOfEach(shape, labels);
    std::map<std::size_t, Patch> patches;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        Patch& patch = patches[roots[i]];
        patch.facing = labels[i] % 6;
        patch.density = density[static_cast<std::size_t>(labels[i] / 6)];
        patch.triangles.push_back(i);
        for (const std::uint32_t vertex : triangleAt(shape, i)) {
            const glm::vec2 p = patch.flat(shape.vertices[vertex].position);
            patch.low = glm::min(patch.low, p);
            patch.high = glm::max(patch.high, p);
        }
    }
    std::vector<Patch> result;
    for (auto& [root, patch] : patches)
        result.push_back(std::move(patch));
    std::stable_sort(result.begin(), result.end(),
                     [](const Patch& a, const Patch& b) { return a.size().y > b.size().y; });
    return result;
}

// Shelves from top to bottom, the tallest patches first. False if they do not fit a square of
// `side` metres.
bool shelve(std::vector<Patch>& patches, float side) {
    const float gap = 2 * margin * side;
    glm::vec2 next(0);
    float shelf = 0;
    for (Patch& patch : patches) {
        const glm::vec2 size = patch.size() + gap;
        if (next.x + size.x > side) {
            next = {0, next.y + shelf};
            shelf = 0;
        }
        patch.corner = next + gap / 2;
        next.x += size.x;
        shelf = std::max(shelf, size.y);
        if (next.x > side || next.y + shelf > side)
            return false;
    }
    return true;
}

} // namespace

std::vector<std::uint32_t> unwrap(Shape& shape, const std::vector<int>& part,
                                  const std::vector<float>& density) {
    std::vector<Patch> patches = patchesOf(shape, part, density);
    float side = 1;
    while (!shelve(patches, side))
        side *= 1.03F;
    const std::vector<Vertex> before = std::move(shape.vertices);
    shape.vertices.clear();
    std::vector<std::uint32_t> origin;
    for (const Patch& patch : patches) {
        std::unordered_map<std::uint32_t, std::uint32_t> copies; // never walked through
        for (const std::size_t triangle : patch.triangles)
            for (std::size_t k = 3 * triangle; k < 3 * triangle + 3; ++k) {
                const std::uint32_t old = shape.indices[k];
                const auto fresh = static_cast<std::uint32_t>(shape.vertices.size());
                const auto [copy, added] = copies.try_emplace(old, fresh);
                if (added) {
                    Vertex vertex = before[old];
                    vertex.uv = (patch.corner + patch.flat(vertex.position) - patch.low) / side;
                    shape.vertices.push_back(vertex);
                    origin.push_back(old);
                }
                shape.indices[k] = copy->second;
            }
    }
    return origin;
}

namespace {

// The weights of a triangle's corners at a place in the atlas.
glm::vec3 weightsAt(const std::array<glm::vec2, 3>& uv, glm::vec2 p) {
    const glm::vec2 e = uv[1] - uv[0], f = uv[2] - uv[0], d = p - uv[0];
    const float area = e.x * f.y - e.y * f.x;
    const float b = (d.x * f.y - d.y * f.x) / area, c = (e.x * d.y - e.y * d.x) / area;
    return {1 - b - c, b, c};
}

struct Painting {
    Image8 image;
    std::vector<bool> done;
};

void paintTriangle(Painting& painting, const Shape& shape, const Triangle& t, const Brush& colour) {
    const int size = painting.image.width;
    std::array<glm::vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k)
        uv[k] = shape.vertices[t[k]].uv * static_cast<float>(size) - 0.5F;
    const glm::ivec2 low(glm::floor(glm::min(glm::min(uv[0], uv[1]), uv[2])));
    const glm::ivec2 high(glm::ceil(glm::max(glm::max(uv[0], uv[1]), uv[2])));
    for (int y = std::max(low.y, 0); y <= std::min(high.y, size - 1); ++y)
        for (int x = std::max(low.x, 0); x <= std::min(high.x, size - 1); ++x) {
            const glm::vec3 weights = weightsAt(uv, {x, y});
            // Not so for the NaN of a triangle seen edge-on.
            if (!(std::min({weights.x, weights.y, weights.z}) >= -1e-4F))
                continue;
            const auto pixel = static_cast<std::size_t>(y * size + x);
            const glm::vec3 code = glm::clamp(colour(t, weights), 0.0F, 1.0F) * 255.0F + 0.5F;
            for (std::size_t channel = 0; channel < 3; ++channel)
                painting.image.pixels[4 * pixel + channel] =
                    static_cast<std::uint8_t>(code[static_cast<int>(channel)]);
            painting.done[pixel] = true;
        }
}

// Each unpainted texel takes the colour of a painted neighbour.
void widen(Painting& painting) {
    const int size = painting.image.width;
    const std::vector<bool> done = painting.done;
    for (int y = 1; y + 1 < size; ++y)
        for (int x = 1; x + 1 < size; ++x) {
            const int pixel = y * size + x;
            if (done[static_cast<std::size_t>(pixel)])
                continue;
            for (const int from : {pixel - 1, pixel + 1, pixel - size, pixel + size})
                if (done[static_cast<std::size_t>(from)]) {
                    std::copy_n(painting.image.pixels.begin() + 4 * from, 3,
                                painting.image.pixels.begin() + 4 * pixel);
                    painting.done[static_cast<std::size_t>(pixel)] = true;
                    break;
                }
        }
}

} // namespace

Image8 paintAtlas(const Shape& shape, int size, const Brush& colour) {
    const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    Painting painting;
    painting.image = {size, size, 4, {}};
    painting.image.pixels.assign(4 * pixels, 255);
    painting.done.resize(pixels);
    for (std::size_t i = 0; i < shape.indices.size() / 3; ++i)
        paintTriangle(painting, shape, triangleAt(shape, i), colour);
    for (int ring = 0; ring < 8; ++ring)
        widen(painting);
    return painting.image;
}

} // namespace obscura::builtin
