#include "protocols/error.h"
#include "protocols/files.h"
#include "renderer/scene.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <tiny_gltf.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <thread>

namespace obscura {

namespace fs = std::filesystem;

namespace {

// tinygltf decodes images itself; ours keeps their bytes for OpenImageIO.
bool keepEncoded(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
    image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

// Reads files for tinygltf and hashes each of them.
struct HashedFiles {
    Sha256 hash;

    static bool read(std::vector<unsigned char>* out, std::string* error, const std::string& path,
                     void* self) {
        try {
            const std::string content = readFile(path);
            static_cast<HashedFiles*>(self)->hash.add(content);
            out->assign(content.begin(), content.end());
            return true;
        } catch (const Error& problem) {
            *error += problem.what();
            return false;
        }
    }
};

tinygltf::Model readModel(const fs::path& path, HashedFiles& files) {
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader(keepEncoded, nullptr);
    reader.SetFsCallbacks({[](const std::string& name, void*) { return fs::exists(name); },
                           [](const std::string& name, void*) { return name; }, HashedFiles::read,
                           nullptr, &files});
    const std::string content = readFile(path);
    files.hash.add(content);
    const auto size = static_cast<unsigned>(content.size());
    const std::string folder = path.parent_path().string();
    tinygltf::Model model;
    std::string errors, warnings;
    const bool binary = content.starts_with("glTF");
    const bool read =
        binary
            ? reader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                          reinterpret_cast<const unsigned char*>(content.data()),
                                          size, folder)
            : reader.LoadASCIIFromString(&model, &errors, &warnings, content.data(), size, folder);
    // A missing texture is only a warning to tinygltf; to us the scene would be another.
    if (!read || warnings.find("not found") != std::string::npos ||
        warnings.find("Failed to load") != std::string::npos) {
        std::string reason = errors.empty() ? warnings : errors;
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        throw Error({path.string(), 0, 0, {}},
                    fmt::format("expected a whole glTF 2.0 scene: {}", reason));
    }
    return model;
}

// One loading: the model on one side, the scene on the other.
class Loader {
  public:
    explicit Loader(const fs::path& path) : path_(path), model_(readModel(path, files_)) {}

    Scene load() {
        checkExtensions();
        for (const tinygltf::Material& material : model_.materials)
            scene_.materials.push_back(convert(material));
        const int index = std::max(model_.defaultScene, 0);
        if (model_.scenes.empty())
            fail("expected a scene, found none");
        for (const int node : model_.scenes[static_cast<std::size_t>(index)].nodes)
            addNode(node, glm::dmat4(1), 0);
        if (scene_.indices.empty())
            fail("expected triangles, found none");
        if (!model_.animations.empty())
            warn("animations are not played: the scene is shown in its bind pose");
        decodeTextures();
        scene_.sha256 = files_.hash.hex();
        return std::move(scene_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw Error({path_.string(), 0, 0, {}}, message);
    }
    void warn(const std::string& message) {
        if (std::find(scene_.warnings.begin(), scene_.warnings.end(), message) ==
            scene_.warnings.end())
            scene_.warnings.push_back(message);
    }

    void checkExtensions() {
        for (const std::string& name : model_.extensionsRequired)
            fail(fmt::format("the scene requires the extension {}, which is not supported; export "
                             "it without",
                             name));
        for (const std::string& name : model_.extensionsUsed)
            warn(fmt::format("extension {} is not supported; it is left out", name));
    }

    // Materials -----------------------------------------------------------------------------

    // The scene's index of a glTF texture as `srgb` or data; -1 for none.
    int textureIndex(int index, int coordinates, bool srgb, const std::string& material) {
        if (index < 0)
            return -1;
        if (coordinates != 0)
            fail(fmt::format("material \"{}\" uses texture coordinate set {}; only set 0 is "
                             "supported",
                             material, coordinates));
        const auto [at, added] =
            textures_.try_emplace({index, srgb}, static_cast<int>(textures_.size()));
        return at->second;
    }

    Material convert(const tinygltf::Material& from) {
        Material to;
        to.name = from.name;
        const auto& pbr = from.pbrMetallicRoughness;
        to.baseColour = glm::vec4(glm::make_vec4(pbr.baseColorFactor.data()));
        to.baseColourTexture = textureIndex(pbr.baseColorTexture.index,
                                            pbr.baseColorTexture.texCoord, true, from.name);
        to.metallic = static_cast<float>(pbr.metallicFactor);
        to.roughness = static_cast<float>(pbr.roughnessFactor);
        to.metallicRoughnessTexture =
            textureIndex(pbr.metallicRoughnessTexture.index, pbr.metallicRoughnessTexture.texCoord,
                         false, from.name);
        to.normalTexture =
            textureIndex(from.normalTexture.index, from.normalTexture.texCoord, false, from.name);
        to.normalScale = static_cast<float>(from.normalTexture.scale);
        to.doubleSided = from.doubleSided;
        if (from.alphaMode == "MASK")
            to.alphaCutoff = std::max(static_cast<float>(from.alphaCutoff), 1e-6f);
        if (from.alphaMode == "BLEND")
            warn(fmt::format("material \"{}\" is translucent; it is drawn opaque", from.name));
        if (from.occlusionTexture.index >= 0)
            warn("baked occlusion textures are left out: they would stand in for the technique");
        if (from.emissiveTexture.index >= 0 ||
            *std::max_element(from.emissiveFactor.begin(), from.emissiveFactor.end()) > 0)
            warn(fmt::format("material \"{}\" emits light; emission is left out", from.name));
        return to;
    }

    // Geometry ------------------------------------------------------------------------------

    static glm::dmat4 transformOf(const tinygltf::Node& node) {
        if (!node.matrix.empty())
            return glm::make_mat4(node.matrix.data());
        glm::dmat4 result(1);
        if (!node.translation.empty())
            result[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1);
        if (!node.rotation.empty())
            result *= glm::mat4_cast(
                glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
        if (!node.scale.empty())
            for (int i = 0; i < 3; ++i)
                result[i] *= node.scale[static_cast<std::size_t>(i)];
        return result;
    }

    void addNode(int index, const glm::dmat4& parent, int depth) {
        if (depth > 256)
            fail("the nodes are nested more than 256 deep, or in a circle");
        const tinygltf::Node& node = model_.nodes.at(static_cast<std::size_t>(index));
        const glm::dmat4 transform = parent * transformOf(node);
        if (node.skin >= 0)
            warn("skins are left out: skinned meshes are shown in their bind pose");
        if (node.mesh >= 0)
            for (const tinygltf::Primitive& primitive :
                 model_.meshes.at(static_cast<std::size_t>(node.mesh)).primitives)
                addPrimitive(primitive, transform);
        for (const int child : node.children)
            addNode(child, transform, depth + 1);
    }

    // The elements of an accessor as floats, `components` of each, normalised integers expanded.
    std::vector<float> floats(int index, int components) const {
        const tinygltf::Accessor& accessor = model_.accessors.at(static_cast<std::size_t>(index));
        if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) <
            components)
            fail(fmt::format("accessor {} has too few components", index));
        std::vector<float> result(accessor.count * static_cast<std::size_t>(components));
        forEachElement(accessor, index, [&](std::size_t i, const unsigned char* element) {
            for (int c = 0; c < components; ++c)
                result[i * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)] =
                    component(element, accessor, c);
        });
        return result;
    }

    template <typename Visit>
    void forEachElement(const tinygltf::Accessor& accessor, int index, Visit visit) const {
        if (accessor.sparse.isSparse || accessor.bufferView < 0)
            fail(fmt::format("accessor {} is sparse or empty, which is not supported", index));
        const auto& view = model_.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
        const auto& buffer = model_.buffers.at(static_cast<std::size_t>(view.buffer)).data;
        const int stride = accessor.ByteStride(view);
        const auto size = static_cast<std::size_t>(
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)) *
            tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
        const std::size_t start = view.byteOffset + accessor.byteOffset;
        if (stride <= 0 || (accessor.count > 0 &&
                            start + (accessor.count - 1) * static_cast<std::size_t>(stride) + size >
                                buffer.size()))
            fail(fmt::format("accessor {} reads past the end of its buffer", index));
        for (std::size_t i = 0; i < accessor.count; ++i)
            visit(i, buffer.data() + start + i * static_cast<std::size_t>(stride));
    }

    template <typename T>
    static T load(const unsigned char* at, int index) {
        T value;
        std::memcpy(&value, at + static_cast<std::size_t>(index) * sizeof(T), sizeof(T));
        return value;
    }

    static float component(const unsigned char* element, const tinygltf::Accessor& accessor,
                           int c) {
        const auto normalised = [&](float value, float largest) {
            return accessor.normalized ? std::max(value / largest, -1.0f) : value;
        };
        switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return normalised(load<std::int8_t>(element, c), 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return normalised(load<std::uint8_t>(element, c), 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return normalised(load<std::int16_t>(element, c), 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return normalised(load<std::uint16_t>(element, c), 65535);
        default:
            return load<float>(element, c);
        }
    }

    std::vector<std::uint32_t> indicesOf(const tinygltf::Primitive& primitive,
                                         std::size_t vertices) const {
        std::vector<std::uint32_t> result;
        if (primitive.indices < 0) {
            for (std::size_t i = 0; i < vertices; ++i)
                result.push_back(static_cast<std::uint32_t>(i));
        } else {
            const auto& accessor = model_.accessors.at(static_cast<std::size_t>(primitive.indices));
            const int type = accessor.componentType;
            forEachElement(accessor, primitive.indices, [&](std::size_t, const unsigned char* at) {
                result.push_back(
                    type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT     ? load<std::uint32_t>(at, 0)
                    : type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? load<std::uint16_t>(at, 0)
                                                                     : load<std::uint8_t>(at, 0));
            });
        }
        for (const std::uint32_t index : result)
            if (index >= vertices)
                fail(fmt::format("index {} points past the {} vertices of its mesh", index,
                                 vertices));
        if (result.size() % 3 != 0)
            fail("expected three indices a triangle");
        return result;
    }

    std::optional<int> attribute(const tinygltf::Primitive& primitive, const char* name) const {
        const auto at = primitive.attributes.find(name);
        return at == primitive.attributes.end() ? std::nullopt : std::optional(at->second);
    }

    void addPrimitive(const tinygltf::Primitive& primitive, const glm::dmat4& worldFromMesh) {
        if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) {
            warn("points, lines, strips and fans are left out; only triangle lists are drawn");
            return;
        }
        if (!primitive.targets.empty())
            warn("morph targets are left out");
        if (attribute(primitive, "COLOR_0"))
            warn("vertex colours are left out");
        const auto position = attribute(primitive, "POSITION");
        if (!position)
            fail("a mesh has no positions");
        std::vector<Vertex> vertices = readVertices(primitive, *position, worldFromMesh);
        std::vector<std::uint32_t> indices = indicesOf(primitive, vertices.size());
        if (glm::determinant(glm::dmat3(worldFromMesh)) < 0) // a mirrored mesh turns its triangles
            for (std::size_t i = 0; i < indices.size(); i += 3)
                std::swap(indices[i + 1], indices[i + 2]);
        if (!attribute(primitive, "NORMAL"))
            makeFlat(vertices, indices);
        append(primitive, vertices, indices);
    }

    std::vector<Vertex> readVertices(const tinygltf::Primitive& primitive, int position,
                                     const glm::dmat4& worldFromMesh) const {
        const std::vector<float> positions = floats(position, 3);
        std::vector<Vertex> vertices(positions.size() / 3);
        const glm::dmat3 normalMatrix = glm::transpose(glm::inverse(glm::dmat3(worldFromMesh)));
        const auto read = [&](const char* name, int components, auto assign) {
            const auto index = attribute(primitive, name);
            if (!index)
                return;
            const std::vector<float> values = floats(*index, components);
            if (values.size() != vertices.size() * static_cast<std::size_t>(components))
                fail(fmt::format("attribute {} has another count than POSITION", name));
            for (std::size_t i = 0; i < vertices.size(); ++i)
                assign(vertices[i], &values[i * static_cast<std::size_t>(components)]);
        };
        for (std::size_t i = 0; i < vertices.size(); ++i)
            vertices[i].position = glm::vec3(
                worldFromMesh * glm::dvec4(glm::dvec3(glm::make_vec3(&positions[i * 3])), 1));
        read("NORMAL", 3, [&](Vertex& vertex, const float* v) {
            vertex.normal = safeNormal(glm::vec3(normalMatrix * glm::dvec3(glm::make_vec3(v))));
        });
        read("TANGENT", 4, [&](Vertex& vertex, const float* v) {
            const glm::dvec3 tangent = glm::dmat3(worldFromMesh) * glm::dvec3(glm::make_vec3(v));
            vertex.tangent = glm::vec4(safeNormal(glm::vec3(tangent)), v[3]);
        });
        read("TEXCOORD_0", 2,
             [](Vertex& vertex, const float* v) { vertex.uv = glm::make_vec2(v); });
        return vertices;
    }

    static glm::vec3 safeNormal(glm::vec3 v) {
        const float length = glm::length(v);
        return length > 0 ? v / length : glm::vec3(0, 1, 0);
    }

    // glTF: without normals, every triangle is flat.
    static void makeFlat(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices) {
        std::vector<Vertex> split;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const Vertex &a = vertices[indices[i]], &b = vertices[indices[i + 1]],
                         &c = vertices[indices[i + 2]];
            const glm::vec3 normal =
                safeNormal(glm::cross(b.position - a.position, c.position - a.position));
            for (Vertex vertex : {a, b, c}) {
                vertex.normal = normal;
                split.push_back(vertex);
            }
        }
        vertices = std::move(split);
        for (std::size_t i = 0; i < indices.size(); ++i)
            indices[i] = static_cast<std::uint32_t>(i);
    }

    void append(const tinygltf::Primitive& primitive, const std::vector<Vertex>& vertices,
                const std::vector<std::uint32_t>& indices) {
        int material = primitive.material;
        if (material < 0) { // glTF's default material
            if (defaultMaterial_ < 0) {
                defaultMaterial_ = static_cast<int>(scene_.materials.size());
                scene_.materials.push_back({.name = "default", .metallic = 1});
            }
            material = defaultMaterial_;
        }
        const auto firstVertex = static_cast<std::uint32_t>(scene_.vertices.size());
        const Mesh mesh{static_cast<std::uint32_t>(scene_.indices.size()),
                        static_cast<std::uint32_t>(indices.size()), material};
        scene_.vertices.insert(scene_.vertices.end(), vertices.begin(), vertices.end());
        for (const std::uint32_t index : indices)
            scene_.indices.push_back(firstVertex + index);
        scene_.meshes.push_back(mesh);
        if (scene_.materials[static_cast<std::size_t>(material)].normalTexture >= 0 &&
            !attribute(primitive, "TANGENT"))
            deriveTangents(scene_, mesh);
    }

    // Textures ------------------------------------------------------------------------------

    // Most of loading time: both cores take the next texture in turn.
    void decodeTextures() {
        scene_.textures.resize(textures_.size());
        std::vector<std::pair<std::pair<int, bool>, int>> work(textures_.begin(), textures_.end());
        std::atomic<std::size_t> next = 0;
        std::vector<std::string> problems(work.size());
        const auto decode = [&] {
            for (std::size_t i; (i = next++) < work.size();)
                try {
                    const auto& [source, target] = work[i];
                    scene_.textures[static_cast<std::size_t>(target)] =
                        decodeTexture(source.first, source.second);
                } catch (const std::exception& error) {
                    problems[i] = error.what();
                }
        };
        {
            std::vector<std::jthread> threads;
            for (unsigned i = 1; i < std::max(std::thread::hardware_concurrency(), 1u); ++i)
                threads.emplace_back(decode);
            decode();
        }
        for (const std::string& problem : problems)
            if (!problem.empty())
                fail(problem);
    }

    Texture decodeTexture(int index, bool srgb) const {
        const tinygltf::Texture& texture = model_.textures.at(static_cast<std::size_t>(index));
        if (texture.source < 0)
            fail(fmt::format("texture {} has no image in a supported format", index));
        const tinygltf::Image& image = model_.images.at(static_cast<std::size_t>(texture.source));
        const bool png = image.image.size() > 1 && image.image[0] == 0x89;
        Texture result;
        result.srgb = srgb;
        result.image =
            readImage8(std::as_bytes(std::span(image.image)),
                       (image.uri.empty() ? image.name : image.uri) + (png ? ".png" : ".jpg"), 4);
        if (texture.sampler >= 0) {
            const auto& sampler = model_.samplers.at(static_cast<std::size_t>(texture.sampler));
            result.repeatU = sampler.wrapS != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
            result.repeatV = sampler.wrapT != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        }
        return result;
    }

    fs::path path_;
    HashedFiles files_;
    tinygltf::Model model_;
    Scene scene_;
    std::map<std::pair<int, bool>, int> textures_; // (glTF texture, srgb) to index in scene_
    int defaultMaterial_ = -1;
};

} // namespace

Scene loadScene(const fs::path& path) {
    if (!fs::exists(path))
        throw Error({path.string(), 0, 0, {}},
                    "expected a glTF scene, found no such file; name the "
                    "scenes folder by --scenes or OBSCURA_SCENES");
    return Loader(path).load();
}

std::string sceneSha256(const fs::path& path) {
    if (!fs::exists(path))
        throw Error({path.string(), 0, 0, {}},
                    "expected a glTF scene, found no such file; name the "
                    "scenes folder by --scenes or OBSCURA_SCENES");
    HashedFiles files;
    readModel(path, files);
    return files.hash.hex();
}

} // namespace obscura
