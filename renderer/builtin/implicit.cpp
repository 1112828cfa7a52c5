#include "renderer/builtin/implicit.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace obscura::builtin {

glm::vec3 gradient(const Field& field, glm::vec3 p, float step) {
    // Four samples at a tetrahedron's corners.
    glm::vec3 sum(0);
    for (const glm::vec3 corner : {glm::vec3(1, -1, -1), {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}})
        sum += corner * field(p + step * corner);
    return sum / (4 * step);
}

float merge(float a, float b, float blend) {
    const float t = std::max(blend - std::abs(a - b), 0.0F) / blend;
    return std::min(a, b) - t * t * blend / 4;
}

float cut(float solid, float hole, float blend) { return -merge(-solid, hole, blend); }

float ellipsoid(glm::vec3 p, glm::vec3 radii) {
    const float scaled = glm::length(p / radii);
    const float steepness = glm::length(p / (radii * radii));
    const float least = std::min({radii.x, radii.y, radii.z});
    return steepness > 1e-6F ? scaled * (scaled - 1) / steepness : -least;
}

float roundedBox(glm::vec3 p, glm::vec3 half, float radius) {
    const glm::vec3 q = glm::abs(p) - half + radius;
    return glm::length(glm::max(q, 0.0F)) + std::min(std::max({q.x, q.y, q.z}), 0.0F) - radius;
}

float limb(glm::vec3 p, glm::vec3 a, glm::vec3 b, float ra, float rb) {
    const glm::vec3 axis = b - a;
    const float t = glm::clamp(glm::dot(p - a, axis) / glm::dot(axis, axis), 0.0F, 1.0F);
    return glm::length(p - a - t * axis) - glm::mix(ra, rb, t);
}

float withLimbs(float solid, glm::vec3 p, std::initializer_list<Limb> limbs) {
    for (const Limb& each : limbs)
        solid =
            merge(solid, limb(p, each.from, each.to, each.fromRadius, each.toRadius), each.blend);
    return solid;
}

glm::vec3 turned(glm::vec3 p, int axis, float degrees) {
    const float c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    glm::vec3 q = p;
    q[u] = c * p[u] - s * p[v];
    q[v] = s * p[u] + c * p[v];
    return q;
}

namespace {

// In a crease finer than a cell the surface may fold back on itself: the vertices of a triangle
// that faces against their normals move to the middle of their neighbours.
void unfold(Shape& shape) {
    std::vector<glm::vec4> sums(shape.vertices.size()); // of neighbours' positions, and their count
    std::vector<std::uint32_t> folded;
    for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> corners{shape.indices[i], shape.indices[i + 1],
                                                   shape.indices[i + 2]};
        const auto vertex = [&](std::size_t k) { return shape.vertices[corners[k % 3]]; };
        const glm::vec3 face = glm::cross(vertex(1).position - vertex(0).position,
                                          vertex(2).position - vertex(0).position);
        for (std::size_t k = 0; k < 3; ++k)
            sums[corners[k]] += glm::vec4(vertex(k + 1).position + vertex(k + 2).position, 2);
        if (glm::dot(face, vertex(0).normal + vertex(1).normal + vertex(2).normal) <= 0)
            folded.insert(folded.end(), corners.begin(), corners.end());
    }
    for (const std::uint32_t i : folded)
        shape.vertices[i].position = glm::vec3(sums[i]) / sums[i].w;
}

constexpr std::uint32_t none = ~0U;
constexpr int block = 4; // cells; blocks that the surface cannot reach are not sampled

class Net {
  public:
    Net(const Field& field, const Bounds& box, float cell)
        : field_(field), low_(box.low), cell_(cell),
          cells_(glm::ivec3(glm::ceil((box.high - box.low) / (cell * block))) * block),
          values_(count(cells_ + 1)), vertexOf_(count(cells_), none) {}

    Shape surface() {
        findNear();
        forEachInParallel(near_.size(), [this](std::size_t i) { sample(near_[i]); });
        forNear([&](glm::ivec3 cell) { addVertex(cell); });
        forEachInParallel(shape_.vertices.size(),
                          [this](std::size_t i) { settle(shape_.vertices[i]); });
        forNear([&](glm::ivec3 corner) { addFaces(corner); });
        for (int round = 0; round < 4; ++round) {
            unfold(shape_);
            mendNormals(shape_);
        }
        splitFolds(shape_);
        return std::move(shape_);
    }

  private:
    static std::size_t count(glm::ivec3 n) {
        return static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
               static_cast<std::size_t>(n.z);
    }
    template <typename Visit>
    static void forEach(glm::ivec3 low, glm::ivec3 high, const Visit& visit) {
        for (int z = low.z; z < high.z; ++z)
            for (int y = low.y; y < high.y; ++y)
                for (int x = low.x; x < high.x; ++x)
                    visit(glm::ivec3(x, y, z));
    }
    template <typename Visit>
    void forNear(const Visit& visit) const {
        for (const glm::ivec3 low : near_)
            forEach(low, low + block, visit);
    }
    static std::size_t index(glm::ivec3 p, glm::ivec3 n) {
        return static_cast<std::size_t>((p.z * n.y + p.y) * n.x + p.x);
    }
    // Of a block's samples; the last block of a row has its far side too.
    glm::ivec3 end(glm::ivec3 low) const {
        return low + block + glm::ivec3(glm::equal(low + block, cells_));
    }
    glm::vec3 place(glm::ivec3 p) const { return low_ + cell_ * glm::vec3(p); }
    float value(glm::ivec3 p) const { return values_[index(p, cells_ + 1)]; }

    void findNear();
    void sample(glm::ivec3 low);
    void addVertex(glm::ivec3 cell);
    void settle(Vertex& vertex) const;
    void addFaces(glm::ivec3 corner);

    const Field& field_;
    glm::vec3 low_;
    float cell_;
    glm::ivec3 cells_;
    std::vector<float> values_;
    std::vector<std::uint32_t> vertexOf_;
    std::vector<glm::ivec3> near_; // the blocks that the surface may cross
    Shape shape_;
};

// The rest of the box keeps the sign of its block's middle.
void Net::findNear() {
    // Half a block's diagonal, with the third by which the field may exceed the distance.
    const float reach = 1.34F * 0.5F * static_cast<float>(block) * cell_ * std::sqrt(3.0F);
    forEach(glm::ivec3(0), cells_ / block, [&](glm::ivec3 b) {
        const glm::ivec3 low = b * block;
        const float middle = field_(place(low) + 0.5F * static_cast<float>(block) * cell_);
        if (std::abs(middle) <= reach)
            near_.push_back(low);
        else
            forEach(low, end(low), [&](glm::ivec3 p) { values_[index(p, cells_ + 1)] = middle; });
    });
}

void Net::sample(glm::ivec3 low) {
    forEach(low, end(low), [&](glm::ivec3 p) { values_[index(p, cells_ + 1)] = field_(place(p)); });
}

// Onto the surface, as far as its cell allows; `normal` is the field's slope in the cell until
// then.
void Net::settle(Vertex& vertex) const {
    const glm::vec3 cell = glm::floor((vertex.position - low_) / cell_);
    const glm::vec3 slope = vertex.normal;
    const glm::vec3 moved =
        vertex.position - slope * field_(vertex.position) / std::max(glm::dot(slope, slope), 0.25F);
    vertex.position =
        glm::clamp(moved, low_ + cell_ * (cell + 0.05F), low_ + cell_ * (cell + 0.95F));
    vertex.normal = glm::normalize(gradient(field_, vertex.position, 0.5F * cell_));
}

void Net::addVertex(glm::ivec3 cell) {
    int inside = 0;
    glm::vec3 slope(0);
    forEach(glm::ivec3(0), glm::ivec3(2), [&](glm::ivec3 corner) {
        const float d = value(cell + corner);
        inside += d < 0 ? 1 : 0;
        slope += (glm::vec3(corner) - 0.5F) * d;
    });
    if (inside == 0 || inside == 8)
        return;
    glm::vec3 sum(0);
    float crossings = 0;
    for (int axis = 0; axis < 3; ++axis)
        for (int edge = 0; edge < 4; ++edge) {
            glm::ivec3 from = cell, step(0);
            from[(axis + 1) % 3] += edge & 1;
            from[(axis + 2) % 3] += edge >> 1;
            step[axis] = 1;
            const float a = value(from), b = value(from + step);
            if ((a < 0) == (b < 0))
                continue;
            sum += glm::vec3(from) + glm::vec3(step) * (a / (a - b));
            crossings += 1;
        }
    vertexOf_[index(cell, cells_)] = static_cast<std::uint32_t>(shape_.vertices.size());
    shape_.vertices.push_back({low_ + cell_ * sum / crossings, slope / (2 * cell_)});
}

// The four cells round each edge that leaves `corner` upwards along an axis.
void Net::addFaces(glm::ivec3 corner) {
    if (std::min({corner.x, corner.y, corner.z}) == 0)
        return; // the box's own faces
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 step(0), u(0), v(0);
        step[axis] = 1;
        u[(axis + 1) % 3] = 1;
        v[(axis + 2) % 3] = 1;
        const bool inside = value(corner) < 0;
        if (inside == (value(corner + step) < 0))
            continue;
        const auto vertex = [&](glm::ivec3 cell) { return vertexOf_[index(cell, cells_)]; };
        std::array<std::uint32_t, 4> quad{vertex(corner - u - v), vertex(corner - v),
                                          vertex(corner), vertex(corner - u)};
        if (!inside)
            std::swap(quad[1], quad[3]);
        // Where a field promises too much distance, its surface has a hole.
        if (std::count(quad.begin(), quad.end(), none) == 0)
            shape_.addQuad(quad);
    }
}

} // namespace

Shape surfaceOf(const Field& field, const Bounds& box, float cell) {
    return Net(field, box, cell).surface();
}

} // namespace obscura::builtin
