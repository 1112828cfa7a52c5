#include "renderer/reference/triangle_tree.h"

#include "base/error.h"
#include "renderer/reference/embree.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <new>

namespace obscura {

namespace {

constexpr unsigned int mostInLeaf = 4; // of the 7 that a node could say

struct Box {
    glm::vec3 low{0}, high{0};
};
Box boxOf(const RTCBounds& b) {
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

// A node as Embree's callbacks make it; a leaf has triangles and no children.
struct Node {
    Node* children[2] = {nullptr, nullptr};
    Box boxes[2]; // of the children
    unsigned int count = 0, triangles[mostInLeaf] = {};
};

Node* newNode(RTCThreadLocalAllocator allocator) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(Node), alignof(Node))) Node;
}
void* createNode(RTCThreadLocalAllocator allocator, unsigned int, void*) {
    return newNode(allocator);
}
void setChildren(void* node, void** children, unsigned int count, void*) {
    for (unsigned int i = 0; i < count; ++i)
        static_cast<Node*>(node)->children[i] = static_cast<Node*>(children[i]);
}
void setBounds(void* node, const RTCBounds** bounds, unsigned int count, void*) {
    for (unsigned int i = 0; i < count; ++i)
        static_cast<Node*>(node)->boxes[i] = boxOf(*bounds[i]);
}
void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                 std::size_t count, void*) {
    Node* node = newNode(allocator);
    node->count = static_cast<unsigned int>(count);
    for (std::size_t i = 0; i < count; ++i)
        node->triangles[i] = primitives[i].primID;
    return node;
}

// A scene's triangle: where its indices begin, and its mesh.
struct Source {
    std::uint32_t first;
    const Mesh* mesh;
};

// Writes the tree in the order of visits.
class Writer {
  public:
    Writer(const Scene& scene, const std::vector<Source>& sources, TriangleTree& tree)
        : scene_(scene), sources_(sources), tree_(tree) {}

    void write(const Node& node, const Box& box) {
        const std::size_t at = tree_.nodes.size();
        const auto bits = [](glm::vec3 v, std::uint32_t w) {
            return glm::uvec4(std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y),
                              std::bit_cast<std::uint32_t>(v.z), w);
        };
        const auto first = static_cast<std::uint32_t>(tree_.triangles.size() / 3);
        tree_.nodes.push_back(bits(box.low, 0));
        tree_.nodes.push_back(bits(box.high, node.count > 0 ? 8 * first + node.count : 0));
        for (unsigned int i = 0; i < node.count; ++i)
            add(sources_[node.triangles[i]]);
        for (int i = 0; i < 2; ++i)
            if (node.children[i])
                write(*node.children[i], node.boxes[i]);
        tree_.nodes[at].w = static_cast<std::uint32_t>(tree_.nodes.size() / 2);
    }

  private:
    void add(const Source& source) {
        const Material& material =
            scene_.materials[static_cast<std::size_t>(source.mesh->material)];
        float mask = -1;
        if (material.alphaCutoff > 0)
            mask = static_cast<float>(addMask(source, material));
        for (std::uint32_t i = 0; i < 3; ++i)
            tree_.triangles.emplace_back(vertex(source, i).position, i == 0 ? mask : 0.0f);
    }
    const Vertex& vertex(const Source& source, std::uint32_t corner) const {
        return scene_.vertices[scene_.indices[source.first + corner]];
    }
    std::size_t addMask(const Source& source, const Material& material) {
        const TextureUse& use = material.baseColourTexture;
        const std::uint32_t map = use.exists() ? mapOf(use.texture) : 0;
        const std::size_t at = tree_.masks.size();
        const auto put = [&](float value) {
            tree_.masks.push_back(std::bit_cast<std::uint32_t>(value));
        };
        for (std::uint32_t i = 0; i < 3; ++i) {
            const glm::vec2 uv = use.at(vertex(source, i));
            put(uv.x);
            put(uv.y);
            put(material.baseColour.a * vertex(source, i).colour.a);
        }
        put(material.alphaCutoff);
        tree_.masks.push_back(map);
        tree_.masks.push_back(0);
        tree_.masks.push_back(0);
        return at;
    }
    std::uint32_t mapOf(int texture) {
        const auto [known, isNew] = maps_.try_emplace(texture, 0);
        if (!isNew)
            return known->second;
        const Texture& from = scene_.textures[static_cast<std::size_t>(texture)];
        tree_.masks.resize(std::max<std::size_t>(tree_.masks.size(), 1)); // 0 is no map's place
        known->second = static_cast<std::uint32_t>(tree_.masks.size());
        tree_.masks.push_back(static_cast<std::uint32_t>(from.image.width));
        tree_.masks.push_back(static_cast<std::uint32_t>(from.image.height));
        tree_.masks.push_back(static_cast<std::uint32_t>(from.wrapU) +
                              4 * static_cast<std::uint32_t>(from.wrapV) + (from.nearest ? 16 : 0));
        for (std::size_t i = 3, shift = 0; i < from.image.pixels.size(); i += 4, shift += 8) {
            if (shift % 32 == 0)
                tree_.masks.push_back(0);
            tree_.masks.back() |= std::uint32_t{from.image.pixels[i]} << (shift % 32);
        }
        return known->second;
    }

    const Scene& scene_;
    const std::vector<Source>& sources_;
    TriangleTree& tree_;
    std::map<int, std::uint32_t> maps_; // places, by texture
};

// A triangle without an area blocks nothing.
std::vector<Source> sourcesOf(const Scene& scene, std::vector<RTCBuildPrimitive>& primitives) {
    std::vector<Source> sources;
    for (const Mesh& mesh : scene.meshes)
        for (std::uint32_t i = mesh.firstIndex; i < mesh.firstIndex + mesh.indexCount; i += 3) {
            const glm::vec3 a = scene.vertices[scene.indices[i]].position,
                            b = scene.vertices[scene.indices[i + 1]].position,
                            c = scene.vertices[scene.indices[i + 2]].position;
            const glm::vec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
            primitives.push_back({low.x, low.y, low.z, 0, high.x, high.y, high.z,
                                  static_cast<unsigned int>(sources.size())});
            sources.push_back({i, &mesh});
        }
    return sources;
}

} // namespace

TriangleTree triangleTree(const Scene& scene) {
    TriangleTree tree;
    std::vector<RTCBuildPrimitive> primitives;
    const std::vector<Source> sources = sourcesOf(scene, primitives);
    if (sources.empty())
        return tree;
    const EmbreeDevice device(rtcNewDevice(nullptr));
    const RTCBVH bvh = device ? rtcNewBVH(device.get()) : nullptr;
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.bvh = bvh;
    arguments.maxLeafSize = mostInLeaf;
    arguments.maxDepth = 64;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    const auto* root = bvh ? static_cast<const Node*>(rtcBuildBVH(&arguments)) : nullptr;
    if (root) {
        const Bounds all = scene.bounds();
        Writer(scene, sources, tree).write(*root, {all.low, all.high});
    }
    rtcReleaseBVH(bvh);
    if (!root)
        throw Error("Embree, the ray tracer, failed to build a tree of the scene's triangles; if "
                    "memory ran out, use a smaller scene");
    return tree;
}

const TriangleBuffers& SceneTriangles::operator()() const {
    if (!buffers_)
        buffers_.emplace(triangleTree(*scene_));
    return *buffers_;
}

} // namespace obscura
