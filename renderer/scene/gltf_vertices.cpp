#include "renderer/scene/gltf_vertices.h"

#include "renderer/scene/gltf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace obscura {

using fmt::format;

namespace {

// The inverse transposed but for a factor, of flattened meshes too: cofactors.
glm::dmat3 normalMatrix(const glm::dmat3& m) {
    return (glm::determinant(m) < 0 ? -1.0 : 1.0) *
           glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
}

bool finite(const glm::vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

// One attribute of a primitive with the morph targets that move it: section 3.7.2.2.
class Morphed {
  public:
    Morphed(const GltfPrimitive& primitive, const std::string& name,
            std::span<const double> weights)
        : base_(primitive.attribute(name)) {
        for (std::size_t t = 0; base_ && t < std::min(weights.size(), primitive.targets()); ++t)
            if (weights[t] != 0)
                if (auto moved = primitive.targetAttribute(t, name))
                    targets_.emplace_back(*moved, weights[t]);
    }

    explicit operator bool() const { return base_.has_value(); }
    int components() const { return base_->components(); }
    glm::dvec3 operator()(std::size_t vertex) const {
        glm::dvec3 sum = vector(*base_, vertex);
        for (const auto& [target, weight] : targets_)
            sum += weight * vector(target, vertex);
        return sum;
    }
    float value(std::size_t vertex, int component) const { return base_->value(vertex, component); }

  private:
    static glm::dvec3 vector(const GltfAccessor& from, std::size_t vertex) {
        return {from.value(vertex, 0), from.value(vertex, 1), from.value(vertex, 2)};
    }

    std::optional<GltfAccessor> base_;
    std::vector<std::pair<GltfAccessor, double>> targets_;
};

class Reader {
  public:
    Reader(const GltfFile& file, const GltfPrimitive& primitive,
           std::span<const std::uint32_t> used, const GltfPose& pose, Piece& piece)
        : file_(file), primitive_(primitive), used_(used), pose_(pose), piece_(piece) {
        piece.vertices.resize(used.size());
    }

    void positions() {
        const Morphed positions(primitive_, "POSITION", pose_.weights);
        for (std::size_t i = 0; i < used_.size(); ++i) {
            const glm::dvec3 mesh = positions(used_[i]);
            const glm::vec4 world(matrix(i) * glm::dvec4(mesh, 1));
            // Beyond this, squares of lengths overflow.
            if (!finite(world) ||
                std::max({std::abs(world.x), std::abs(world.y), std::abs(world.z)}) > 1e15f)
                failGltf(file_.path(), primitive_.at() + ".attributes.POSITION",
                         format("expected finite positions, found ({}, {}, {}) as vertex {}, which "
                                "is ({}, {}, {}) in the scene",
                                mesh.x, mesh.y, mesh.z, used_[i], world.x, world.y, world.z));
            piece_.vertices[i].position = glm::vec3(world);
        }
    }

    void normals() {
        const Morphed normals(primitive_, "NORMAL", pose_.weights);
        for (std::size_t i = 0; normals && i < used_.size(); ++i)
            piece_.vertices[i].normal =
                direction(normalMatrix(glm::dmat3(matrix(i))) * normals(used_[i]));
    }

    void tangents() {
        const Morphed tangents(primitive_, "TANGENT", pose_.weights);
        for (std::size_t i = 0; tangents && i < used_.size(); ++i)
            piece_.vertices[i].tangent =
                glm::vec4(direction(glm::dmat3(matrix(i)) * tangents(used_[i])),
                          tangents.value(used_[i], 3) < 0 ? -1 : 1);
    }

    // How many of them were no finite numbers, and are 0.
    std::size_t coordinates(int set, glm::vec2 Vertex::*uv) {
        const auto from = primitive_.attribute(format("TEXCOORD_{}", set));
        std::size_t lost = 0;
        for (std::size_t i = 0; from && i < used_.size(); ++i) {
            const glm::vec2 found(from->value(used_[i], 0), from->value(used_[i], 1));
            const bool good = std::isfinite(found.x) && std::isfinite(found.y);
            piece_.vertices[i].*uv = good ? found : glm::vec2(0);
            lost += !good;
        }
        return lost;
    }

    // How many of them were no finite numbers, and are white. Whole numbers are shares: files that
    // forget to say so mean nothing else.
    std::size_t colours() {
        auto from = primitive_.attribute("COLOR_0");
        if (!from)
            return 0;
        from->normalise();
        std::size_t lost = 0;
        for (std::size_t i = 0; i < used_.size(); ++i) {
            glm::vec4 found(1);
            for (int c = 0; c < from->components(); ++c)
                found[c] = from->value(used_[i], c);
            const bool good = finite(found);
            piece_.vertices[i].colour = good ? glm::max(found, glm::vec4(0)) : glm::vec4(1);
            lost += !good;
        }
        return lost;
    }

  private:
    const glm::dmat4& matrix(std::size_t vertex) const {
        return pose_.worldFromMesh.size() == 1 ? pose_.worldFromMesh.front()
                                               : pose_.worldFromMesh[vertex];
    }

    const GltfFile& file_;
    const GltfPrimitive& primitive_;
    std::span<const std::uint32_t> used_;
    const GltfPose& pose_;
    Piece& piece_;
};

} // namespace

void readVertices(const GltfFile& file, const GltfPrimitive& primitive,
                  std::span<const std::uint32_t> used, const GltfPose& pose,
                  const std::function<void(const std::string&)>& warn, Piece& piece) {
    Reader reader(file, primitive, used, pose, piece);
    reader.positions();
    reader.normals();
    reader.tangents();
    if (const std::size_t lost = reader.coordinates(pose.coordinates[0], &Vertex::uv) +
                                 reader.coordinates(pose.coordinates[1], &Vertex::uv1))
        warn(format("{}: {} texture coordinates are no finite numbers; 0 stands in", primitive.at(),
                    lost));
    if (const std::size_t lost = reader.colours())
        warn(format("{}: {} vertex colours are no finite numbers; white stands in", primitive.at(),
                    lost));
}

} // namespace obscura
