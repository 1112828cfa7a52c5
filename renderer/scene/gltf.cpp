#include "base/error.h"
#include "renderer/scene/gltf_check.h"
#include "renderer/scene/gltf_extensions.h"
#include "renderer/scene/gltf_file.h"
#include "renderer/scene/gltf_materials.h"
#include "renderer/scene/gltf_model.h"
#include "renderer/scene/gltf_piece.h"
#include "renderer/scene/gltf_placed.h"
#include "renderer/scene/gltf_primitive.h"
#include "renderer/scene/gltf_skin.h"
#include "renderer/scene/gltf_vertices.h"
#include "renderer/scene/scene.h"

#include <fmt/format.h>

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

// One loading: the model on one side, the scene on the other.
class Loader {
  public:
    explicit Loader(const fs::path& path)
        : file_(path), model_(modelOf(file_)),
          materials_(file_, model_, [this](const std::string& message) { warn(message); }) {}

    Scene load() {
        for (const std::string& sentence : extensionsLeftOut(file_.root()))
            warn(sentence);
        file_.unpack();
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
        addCamerasAndLights();
        if (scene_.indices.empty())
            failGltf(file_.path(), "", "expected triangles, found none");
        for (const auto& camera : file_.root().value("cameras", nlohmann::json::array()))
            if (camera.at("type") == "orthographic")
                warn("orthographic cameras are left out");
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
        const std::size_t primitives =
            model_.meshes[static_cast<std::size_t>(node.mesh)].primitives.size();
        const auto i = static_cast<std::size_t>(index);
        for (const glm::dmat4& worldFromMesh : instancesOf(file_, model_, i, *worldFromNode_[i]))
            for (std::size_t k = 0; k < primitives; ++k)
                addPrimitive(primitive(node.mesh, k), node, worldFromMesh);
    }

    void addCamerasAndLights() {
        const Bounds bounds = scene_.bounds();
        const glm::dvec3 middle((bounds.low + bounds.high) / 2.0f);
        for (const int node : placed_) {
            const auto i = static_cast<std::size_t>(node);
            if (auto camera = cameraOf(file_.root(), i, *worldFromNode_[i], middle))
                scene_.cameras.push_back(std::move(*camera));
            if (const auto light = lightOf(file_.root(), i, *worldFromNode_[i]))
                scene_.lights.push_back(*light);
        }
    }

    // Primitives --------------------------------------------------------------------------------

    std::size_t cornersLeft() const { return 3 * mostTriangles - scene_.indices.size(); }

    // Each is read once, however many nodes show it.
    const GltfPrimitive& primitive(int mesh, std::size_t index) {
        const std::pair key(mesh, index);
        auto found = primitives_.find(key);
        if (found == primitives_.end())
            found =
                primitives_.emplace(key, GltfPrimitive(file_, model_, mesh, index, cornersLeft()))
                    .first;
        return found->second;
    }

    // Morph weights: the node's, or its mesh's.
    std::vector<double> weightsOf(const tinygltf::Node& node) const {
        return node.weights.empty() ? model_.meshes[static_cast<std::size_t>(node.mesh)].weights
                                    : node.weights;
    }

    void addPrimitive(const GltfPrimitive& primitive, const tinygltf::Node& node,
                      const glm::dmat4& worldFromMesh) {
        if (!primitive.isTriangles()) {
            warn("points and lines are left out");
            return;
        }
        Piece piece;
        piece.corners = primitive.corners(cornersLeft());
        // Only the vertices that the triangles use, in their order: buffers may be shared.
        std::vector<std::uint32_t> used = piece.corners;
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (std::uint32_t& corner : piece.corners)
            corner = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) -
                                                used.begin());
        GltfPose pose;
        pose.weights = weightsOf(node);
        pose.worldFromMesh =
            node.skin < 0 ? std::vector{worldFromMesh}
                          : skinned(file_, primitive,
                                    jointsOf(file_, model_, node.skin, worldFromNode_), used);
        if (primitive.material() >= 0)
            pose.coordinates = materials_.coordinates(primitive.material());
        const auto warner = [this](const std::string& message) { warn(message); };
        readVertices(file_, primitive, used, pose, warner, piece);
        // A mirrored mesh turns its triangles.
        if (!used.empty() && glm::determinant(glm::dmat3(pose.worldFromMesh.front())) < 0)
            for (std::size_t i = 0; i < piece.corners.size(); i += 3)
                std::swap(piece.corners[i + 1], piece.corners[i + 2]);
        if (!primitive.has("NORMAL"))
            makeFlat(piece);
        else if (const std::size_t mended = mendNormals(piece))
            warn(format("{}: {} normals have no direction; those of the triangles around stand in",
                        primitive.at(), mended));
        append(primitive, std::move(piece));
    }

    int materialOf(const GltfPrimitive& primitive) {
        if (primitive.material() >= 0)
            return primitive.material();
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

    void append(const GltfPrimitive& primitive, Piece piece) {
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
        if (!primitive.has("TANGENT"))
            deriveTangents(scene_, mesh);
        Undirected& sum = undirected_[index];
        if (const std::size_t lost = dropUnusableTangents(scene_, mesh)) {
            sum.lost += lost;
            sum.first = sum.first.empty() ? primitive.at() : sum.first;
        }
        sum.all += piece.vertices.size();
    }

    GltfFile file_;
    tinygltf::Model model_;
    Scene scene_;
    std::set<std::string> said_;
    GltfMaterials materials_;
    std::map<std::pair<int, std::size_t>, GltfPrimitive> primitives_; // by mesh and index
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
