#include "base/error.h"
#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/gltf_check.h"
#include "renderer/scene/gltf_extensions.h"
#include "renderer/scene/gltf_file.h"
#include "renderer/scene/gltf_materials.h"
#include "renderer/scene/gltf_piece.h"
#include "renderer/scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace obscura {

namespace fs = std::filesystem;
using fmt::format;

namespace {

constexpr int deepestNode = 256;
constexpr std::size_t mostTriangles = 50'000'000; // of all instances together: some 7 GB

// tinygltf reads the structure alone: buffers, images and everything that is not shown are ours or
// nobody's, so that it opens no file and trusts no length.
tinygltf::Model modelOf(const GltfFile& file) {
    nlohmann::json structure;
    for (const char* key : {"asset", "scene", "scenes", "nodes", "meshes", "materials", "textures",
                            "samplers", "accessors", "bufferViews", "skins"})
        if (file.root().contains(key))
            structure[key] = file.root().at(key);
    const std::string text =
        structure.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string errors, warnings;
    if (!reader.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                    static_cast<unsigned>(text.size()), "")) {
        std::replace(errors.begin(), errors.end(), '\n', ' ');
        failGltf(file.path(), "", "expected a glTF 2.0 scene: " + errors);
    }
    return model;
}

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// One loading: the model on one side, the scene on the other.
class Loader {
  public:
    explicit Loader(const fs::path& path)
        : file_(path), model_(modelOf(file_)),
          materials_(file_, model_, [this](const std::string& message) { warn(message); }) {}

    Scene load() {
        for (const std::string& sentence : extensionsLeftOut(file_.root()))
            warn(sentence);
        scene_.materials = materials_.materials();
        scene_.textures = materials_.textures();
        if (model_.scenes.empty())
            failGltf(file_.path(), "scenes", "expected a scene, found none");
        if (model_.defaultScene < 0 && model_.scenes.size() > 1)
            warn(format("the file has {} scenes and says of none that it is to be shown; the first "
                        "is",
                        model_.scenes.size()));
        worldFromNode_.resize(model_.nodes.size());
        for (const int node :
             model_.scenes[static_cast<std::size_t>(std::max(model_.defaultScene, 0))].nodes)
            place(node, glm::dmat4(1), 0);
        for (const int node : placed_)
            addMeshOf(node);
        if (scene_.indices.empty())
            failGltf(file_.path(), "", "expected triangles, found none");
        if (file_.root().contains("animations") && !file_.root().at("animations").empty())
            warn("animations are not played: the scene is shown as its nodes stand in the file");
        warnOfNormalMaps();
        scene_.sha256 = file_.sha256();
        return std::move(scene_);
    }

  private:
    void warn(const std::string& message) {
        if (said_.insert(message).second)
            scene_.warnings.push_back(message);
    }

    // Once for each material: its meshes may be hundreds.
    void warnOfNormalMaps() {
        for (const auto& [material, sum] : undirected_)
            if (sum.lost > 0)
                warn(format("material \"{}\": its normal map has no direction at {} of {} vertices "
                            "({} is the first mesh with such), whose tangents or texture "
                            "coordinates are missing or degenerate; the vertex normal stands in",
                            scene_.materials[static_cast<std::size_t>(material)].name, sum.lost,
                            sum.all, sum.first));
    }

    // Nodes -------------------------------------------------------------------------------------

    static glm::dmat4 transformOf(const tinygltf::Node& node) {
        if (!node.matrix.empty())
            return glm::make_mat4(node.matrix.data());
        glm::dmat4 result(1);
        if (!node.translation.empty())
            result[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1);
        if (!node.rotation.empty())
            result *= glm::mat4_cast(glm::normalize(glm::dquat(
                node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2])));
        if (!node.scale.empty())
            for (int i = 0; i < 3; ++i)
                result[i] *= node.scale[static_cast<std::size_t>(i)];
        return result;
    }

    // Where each node of the scene is, in its order: joints may come after what hangs on them.
    void place(int index, const glm::dmat4& parent, int depth) {
        const auto i = static_cast<std::size_t>(index);
        const std::string at = format("nodes[{}]", index);
        if (worldFromNode_[i])
            failGltf(file_.path(), at,
                     "expected a tree of nodes, found two ways to this one, or a circle");
        if (depth > deepestNode)
            failGltf(file_.path(), at,
                     format("expected nodes nested at most {} deep, found deeper", deepestNode));
        worldFromNode_[i] = parent * transformOf(model_.nodes[i]);
        placed_.push_back(index);
        for (const int child : model_.nodes[i].children)
            place(child, *worldFromNode_[i], depth + 1);
    }

    void addMeshOf(int index) {
        const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
        if (node.mesh < 0)
            return;
        const auto& primitives = model_.meshes[static_cast<std::size_t>(node.mesh)].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i)
            addPrimitive(primitives[i], node.skin, *worldFromNode_[static_cast<std::size_t>(index)],
                         format("meshes[{}].primitives[{}]", node.mesh, i));
    }

    // Skins -------------------------------------------------------------------------------------

    // From the mesh to the world by each joint, as the joints' nodes stand in the file.
    std::vector<glm::dmat4> jointsOf(int skin) const {
        const tinygltf::Skin& from = model_.skins[static_cast<std::size_t>(skin)];
        std::optional<GltfAccessor> inverse;
        const std::string at = format("skins[{}]", skin);
        if (from.inverseBindMatrices >= 0) {
            inverse.emplace(file_, model_, from.inverseBindMatrices);
            if (inverse->components() != 16 || inverse->count() < from.joints.size())
                failGltf(file_.path(), at + ".inverseBindMatrices",
                         format("expected a matrix of 16 for each of {} joints, found {} of {}",
                                from.joints.size(), inverse->count(), inverse->components()));
        }
        std::vector<glm::dmat4> joints;
        for (std::size_t j = 0; j < from.joints.size(); ++j) {
            const auto& world = worldFromNode_[static_cast<std::size_t>(from.joints[j])];
            glm::dmat4 joint = world.value_or(glm::dmat4(1));
            if (inverse) {
                glm::dmat4 bind(1);
                for (int c = 0; c < 16; ++c)
                    bind[c / 4][c % 4] = inverse->value(j, c);
                joint *= bind;
            }
            joints.push_back(joint);
        }
        return joints;
    }

    // From the mesh to the world for each vertex: section 3.7.3.3. A skinned mesh hangs on its
    // joints alone, wherever its own node is.
    std::vector<glm::dmat4> skinned(const tinygltf::Primitive& primitive, int skin,
                                    const std::vector<std::uint32_t>& used,
                                    const std::string& at) const {
        const auto joints = attribute(primitive, "JOINTS_0", at),
                   weights = attribute(primitive, "WEIGHTS_0", at);
        if (!joints || !weights)
            failGltf(file_.path(), at + ".attributes",
                     "expected JOINTS_0 and WEIGHTS_0 of a skinned mesh, found only one or none");
        const std::vector<glm::dmat4> matrices = jointsOf(skin);
        std::vector<glm::dmat4> result;
        for (const std::uint32_t vertex : used) {
            if (vertex >= joints->count() || vertex >= weights->count())
                failGltf(
                    file_.path(), at + ".attributes.JOINTS_0",
                    format("expected as many elements as POSITION has, found {} and {} weights",
                           joints->count(), weights->count()));
            glm::dmat4 sum(0);
            double total = 0;
            for (int k = 0; k < 4; ++k) {
                const auto joint = static_cast<std::size_t>(joints->value(vertex, k));
                const auto weight = static_cast<double>(weights->value(vertex, k));
                if (!(weight > 0))
                    continue;
                if (joint >= matrices.size())
                    failGltf(file_.path(), at + ".attributes.JOINTS_0",
                             format("joint {} of vertex {} points past the {} joints of its skin",
                                    joint, vertex, matrices.size()));
                sum += weight * matrices[joint];
                total += weight;
            }
            result.push_back(total > 0 ? sum / total : glm::dmat4(1));
        }
        return result;
    }

    // Primitives --------------------------------------------------------------------------------

    std::optional<GltfAccessor> attribute(const tinygltf::Primitive& primitive, const char* name,
                                          const std::string& at) const {
        const auto found = primitive.attributes.find(name);
        if (found == primitive.attributes.end())
            return std::nullopt;
        return accessor(found->second, name, at + ".attributes." + name);
    }

    // With as many components as meshes may have there (section 3.7.2.1, and
    // KHR_mesh_quantization).
    GltfAccessor accessor(int index, const std::string& name, const std::string& at) const {
        GltfAccessor result(file_, model_, index);
        const int expected = name.starts_with("TEXCOORD")             ? 2
                             : name == "POSITION" || name == "NORMAL" ? 3
                                                                      : 4;
        const bool whole = result.componentType() == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        if (result.components() != expected || whole)
            failGltf(file_.path(), at,
                     format("expected an accessor of {} floats, bytes or shorts each, found "
                            "accessors[{}] with {}{}",
                            expected, index, result.components(), whole ? " of 32 bits" : ""));
        return result;
    }

    // Which vertices the triangles have, three each.
    std::vector<std::uint32_t> cornersOf(const tinygltf::Primitive& primitive, std::size_t vertices,
                                         const std::string& at) const {
        std::vector<std::uint32_t> order;
        if (primitive.indices < 0) {
            limit(vertices, at);
            for (std::size_t i = 0; i < vertices; ++i)
                order.push_back(static_cast<std::uint32_t>(i));
        } else {
            const GltfAccessor indices(file_, model_, primitive.indices);
            const int type = indices.componentType();
            if (indices.components() != 1 || (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
                                              type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
                                              type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
                failGltf(file_.path(), at + ".indices",
                         format("expected an accessor of unsigned whole numbers, found "
                                "accessors[{}] of another kind",
                                primitive.indices));
            limit(indices.count(), at);
            for (std::size_t i = 0; i < indices.count(); ++i) {
                order.push_back(indices.whole(i));
                if (order.back() >= vertices)
                    failGltf(file_.path(), format("{}.indices", at),
                             format("index {} points past the {} vertices of its mesh",
                                    order.back(), vertices));
            }
        }
        return triangles(std::move(order), primitive.mode, at);
    }

    void limit(std::size_t corners, const std::string& at) const {
        if (scene_.indices.size() + corners > 3 * mostTriangles)
            failGltf(
                file_.path(), at,
                format("expected a scene of at most {} triangles, all instances counted, found "
                       "more",
                       mostTriangles));
    }

    std::vector<std::uint32_t> triangles(std::vector<std::uint32_t> order, int mode,
                                         const std::string& at) const {
        if (mode == TINYGLTF_MODE_TRIANGLES || mode == -1) {
            if (order.size() % 3 != 0)
                failGltf(
                    file_.path(), at,
                    format("expected three vertices a triangle, found {} vertices", order.size()));
            return order;
        }
        limit(3 * order.size(), at);
        std::vector<std::uint32_t> result;
        for (std::size_t i = 2; i < order.size(); ++i) {
            const bool fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
            const std::size_t odd = fan ? 0 : i % 2;
            result.insert(result.end(), {fan ? order[0] : order[i - 2 + odd],
                                         fan ? order[i - 1] : order[i - 1 - odd], order[i]});
        }
        return result;
    }

    void addPrimitive(const tinygltf::Primitive& primitive, int skin,
                      const glm::dmat4& worldFromNode, const std::string& at) {
        if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES) {
            warn("points and lines are left out");
            return;
        }
        if (!primitive.targets.empty())
            warn("morph targets are left out");
        if (primitive.attributes.contains("COLOR_0"))
            warn("vertex colours are left out");
        const auto positions = attribute(primitive, "POSITION", at);
        if (!positions)
            failGltf(file_.path(), at + ".attributes", "expected POSITION, found none");
        Piece piece;
        piece.corners = cornersOf(primitive, positions->count(), at);
        // Only the vertices that the triangles use, in their order: buffers may be shared.
        std::vector<std::uint32_t> used = piece.corners;
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (std::uint32_t& corner : piece.corners)
            corner = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) -
                                                used.begin());
        piece.vertices.resize(used.size());
        const std::vector<glm::dmat4> worldFromMesh =
            skin < 0 ? std::vector{worldFromNode} : skinned(primitive, skin, used, at);
        readPositions(*positions, used, worldFromMesh, at, piece);
        readAttributes(primitive, positions->count(), used, worldFromMesh, at, piece);
        const double turns = glm::determinant(glm::dmat3(worldFromMesh.front()));
        if (turns < 0) // a mirrored mesh turns its triangles
            for (std::size_t i = 0; i < piece.corners.size(); i += 3)
                std::swap(piece.corners[i + 1], piece.corners[i + 2]);
        if (!primitive.attributes.contains("NORMAL"))
            makeFlat(piece);
        else if (const std::size_t mended = mendNormals(piece))
            warn(format("{}: {} normals have no direction; those of the triangles around stand in",
                        at, mended));
        append(primitive, std::move(piece), at);
    }

    // One for all vertices, or one for each.
    static const glm::dmat4& matrixOf(const std::vector<glm::dmat4>& all, std::size_t vertex) {
        return all.size() == 1 ? all.front() : all[vertex];
    }

    // The inverse transposed but for a factor, of flattened meshes too: cofactors.
    static glm::dmat3 normalMatrix(const glm::dmat3& m) {
        return (glm::determinant(m) < 0 ? -1.0 : 1.0) *
               glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    }

    void readPositions(const GltfAccessor& positions, const std::vector<std::uint32_t>& used,
                       const std::vector<glm::dmat4>& worldFromMesh, const std::string& at,
                       Piece& piece) const {
        for (std::size_t i = 0; i < used.size(); ++i) {
            const glm::dvec3 mesh(positions.value(used[i], 0), positions.value(used[i], 1),
                                  positions.value(used[i], 2));
            const glm::vec3 world(matrixOf(worldFromMesh, i) * glm::dvec4(mesh, 1));
            // Beyond this, squares of lengths overflow.
            if (!finite(world) ||
                std::max({std::abs(world.x), std::abs(world.y), std::abs(world.z)}) > 1e15f)
                failGltf(file_.path(), at + ".attributes.POSITION",
                         format("expected finite positions, found ({}, {}, {}) as vertex {}, which "
                                "is ({}, {}, {}) in the scene",
                                mesh.x, mesh.y, mesh.z, used[i], world.x, world.y, world.z));
            piece.vertices[i].position = world;
        }
    }

    void readAttributes(const tinygltf::Primitive& primitive, std::size_t count,
                        const std::vector<std::uint32_t>& used,
                        const std::vector<glm::dmat4>& worldFromMesh, const std::string& at,
                        Piece& piece) {
        const auto read = [&](const std::string& name, auto assign) {
            const auto values = attribute(primitive, name.c_str(), at);
            if (!values)
                return;
            if (values->count() != count)
                failGltf(file_.path(), at + ".attributes." + name,
                         format("expected the {} elements of POSITION, found {}", count,
                                values->count()));
            for (std::size_t i = 0; i < used.size(); ++i)
                assign(
                    piece.vertices[i], [&](int c) { return values->value(used[i], c); }, i);
        };
        read("NORMAL", [&](Vertex& vertex, const auto& value, std::size_t i) {
            vertex.normal = direction(normalMatrix(glm::dmat3(matrixOf(worldFromMesh, i))) *
                                      glm::dvec3(value(0), value(1), value(2)));
        });
        read("TANGENT", [&](Vertex& vertex, const auto& value, std::size_t i) {
            const glm::vec3 tangent = direction(glm::dmat3(matrixOf(worldFromMesh, i)) *
                                                glm::dvec3(value(0), value(1), value(2)));
            vertex.tangent = glm::vec4(tangent, value(3) < 0 ? -1 : 1);
        });
        const GltfMaterials::Coordinates sets = primitive.material < 0
                                                    ? GltfMaterials::Coordinates{0, -1}
                                                    : materials_.coordinates(primitive.material);
        std::size_t lost = 0;
        for (const std::size_t set : {std::size_t{0}, std::size_t{1}})
            read(format("TEXCOORD_{}", sets[set]),
                 [&](Vertex& vertex, const auto& value, std::size_t) {
                     glm::vec2& uv = set == 0 ? vertex.uv : vertex.uv1;
                     uv = {value(0), value(1)};
                     if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
                         uv = glm::vec2(0);
                         ++lost;
                     }
                 });
        if (lost > 0)
            warn(format("{}: {} texture coordinates are no finite numbers; 0 stands in", at, lost));
    }

    int materialOf(const tinygltf::Primitive& primitive) {
        if (primitive.material >= 0)
            return primitive.material;
        if (defaultMaterial_ < 0) { // glTF's own
            defaultMaterial_ = static_cast<int>(scene_.materials.size());
            scene_.materials.push_back({.name = "default", .metallic = 1});
        }
        return defaultMaterial_;
    }

    // Whether the material stays as it is when Vertex::uv is moved by whole periods along u, and
    // along v: all its textures repeat there, and none is scaled or turned.
    std::pair<bool, bool> repeats(const Material& material) const {
        std::pair<bool, bool> result(false, false);
        bool first = true;
        for (const TextureUse& use : {material.baseColourTexture, material.normalTexture,
                                      material.metallicRoughnessTexture, material.emissionTexture})
            if (use.exists() && use.set == 0) {
                const Texture& texture = scene_.textures[static_cast<std::size_t>(use.texture)];
                const auto along = [&](bool before, Wrap wrap) {
                    return (first || before) && wrap != Wrap::clamp && use.plain();
                };
                result = {along(result.first, texture.wrapU), along(result.second, texture.wrapV)};
                first = false;
            }
        return result;
    }

    void append(const tinygltf::Primitive& primitive, Piece piece, const std::string& at) {
        const int index = materialOf(primitive);
        const Material& material = scene_.materials[static_cast<std::size_t>(index)];
        const auto [alongU, alongV] = repeats(material);
        recentre(piece, alongU, alongV);
        const auto firstVertex = static_cast<std::uint32_t>(scene_.vertices.size());
        const Mesh mesh{static_cast<std::uint32_t>(scene_.indices.size()),
                        static_cast<std::uint32_t>(piece.corners.size()), index};
        scene_.vertices.insert(scene_.vertices.end(), piece.vertices.begin(), piece.vertices.end());
        for (const std::uint32_t corner : piece.corners)
            scene_.indices.push_back(firstVertex + corner);
        if (mesh.indexCount > 0)
            scene_.meshes.push_back(mesh);
        if (!material.normalTexture.exists())
            return;
        if (!primitive.attributes.contains("TANGENT"))
            deriveTangents(scene_, mesh);
        Undirected& sum = undirected_[index];
        if (const std::size_t lost = dropUnusableTangents(scene_, mesh)) {
            sum.lost += lost;
            sum.first = sum.first.empty() ? at : sum.first;
        }
        sum.all += piece.vertices.size();
    }

    GltfFile file_;
    tinygltf::Model model_;
    Scene scene_;
    std::set<std::string> said_;
    GltfMaterials materials_;
    struct Undirected { // vertices of a material with a normal map
        std::size_t lost = 0, all = 0;
        std::string first; // mesh with a lost one
    };
    std::map<int, Undirected> undirected_;                 // by material
    std::vector<std::optional<glm::dmat4>> worldFromNode_; // of the scene's nodes
    std::vector<int> placed_;                              // in the scene's order
    int defaultMaterial_ = -1;
};

} // namespace

Scene loadScene(const fs::path& path) { return Loader(path).load(); }

std::string sceneSha256(const fs::path& path) { return GltfFile(path).sha256(); }

} // namespace obscura
