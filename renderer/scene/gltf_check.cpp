#include "renderer/scene/gltf_check.h"

#include "renderer/scene/gltf_check_materials.h"
#include "renderer/scene/gltf_extensions.h"
#include "renderer/scene/gltf_json.h"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <numbers>
#include <string>

namespace obscura {

using fmt::format;
using nlohmann::json;

namespace {

class Checker : private GltfJson {
  public:
    using GltfJson::GltfJson;

    void run() const {
        checkAsset();
        checkGltfExtensions(*this);
        for (const char* name :
             {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials",
              "meshes", "nodes", "samplers", "scenes", "skins", "textures"})
            each(name, [](const json&, const std::string&) {}); // all are objects
        each("buffers", [&](const json& o, const std::string& at) {
            whole(o, "byteLength", at, 1, mostBytes, true);
            text(o, "uri", at);
            if (const json* packed = extension(o, "EXT_meshopt_compression", at))
                flag(*packed, "fallback", extensionPath(at, "EXT_meshopt_compression"));
        });
        each("bufferViews", [&](const json& o, const std::string& at) { checkView(o, at); });
        each("accessors", [&](const json& o, const std::string& at) { checkAccessor(o, at); });
        checkGltfMaterials(*this);
        each("cameras", [&](const json& o, const std::string& at) { checkCamera(o, at); });
        each("meshes", [&](const json& o, const std::string& at) { checkMesh(o, at); });
        checkLights();
        each("nodes", [&](const json& o, const std::string& at) { checkNode(o, at); });
        each("skins", [&](const json& skin, const std::string& at) {
            indices(skin, "joints", at, "nodes");
            index(skin, "inverseBindMatrices", at, "accessors");
            index(skin, "skeleton", at, "nodes");
        });
        each("scenes", [&](const json& scene, const std::string& at) {
            indices(scene, "nodes", at, "nodes");
        });
        index(root(), "scene", "", "scenes");
    }

  private:
    void checkAsset() const {
        const json* asset = object(root(), "asset", "");
        if (!asset)
            fail("asset", "expected the glTF version, found no asset: is this a glTF 2.0 file?");
        for (const char* key : {"version", "minVersion"}) {
            const auto version = text(*asset, key, "asset");
            if (!version && std::string(key) == "version")
                fail("asset.version", "expected \"2.0\", found none");
            if (version && !(version->starts_with("2.") && version->size() > 2) && *version != "2")
                fail(join("asset", key), format("expected \"2.0\", found \"{}\"", *version));
        }
    }

    // Buffers, views, accessors -----------------------------------------------------------------

    std::int64_t lengthOf(const char* array, std::size_t i) const {
        return static_cast<std::int64_t>(root().at(array)[i].at("byteLength").get<double>());
    }

    // Bytes of a buffer, by their keys; returns how many.
    std::int64_t checkBytes(const json& part, const std::string& at) const {
        const std::size_t buffer = *index(part, "buffer", at, "buffers", true);
        const std::int64_t offset = whole(part, "byteOffset", at, 0, mostBytes).value_or(0),
                           length = *whole(part, "byteLength", at, 1, mostBytes, true),
                           all = lengthOf("buffers", buffer);
        if (offset + length > all)
            fail(at, format("expected a view within the {} bytes of buffers[{}], found {} bytes "
                            "from {}",
                            all, buffer, length, offset));
        return length;
    }

    void checkView(const json& view, const std::string& at) const {
        const std::int64_t length = checkBytes(view, at);
        const auto stride = whole(view, "byteStride", at, 4, 252);
        if (stride && *stride % 4 != 0)
            fail(join(at, "byteStride"), format("expected a multiple of 4, found {}", *stride));
        if (const json* packed = extension(view, "EXT_meshopt_compression", at))
            checkMeshopt(*packed, extensionPath(at, "EXT_meshopt_compression"), length);
    }

    // What the decoder asserts or trusts, and how much it unpacks: meshoptimizer's vertex codec
    // spends at least two bits on each sixteen bytes that lie a stride apart, its index codecs a
    // byte on each triangle and each index.
    void checkMeshopt(const json& packed, const std::string& at, std::int64_t unpacked) const {
        const std::int64_t length = checkBytes(packed, at);
        oneOf(packed, "mode", at, {"ATTRIBUTES", "TRIANGLES", "INDICES"}, true);
        oneOf(packed, "filter", at, {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"});
        const auto mode = packed.at("mode").get<std::string>();
        const auto filter = packed.value("filter", "NONE");
        const std::int64_t stride = *whole(packed, "byteStride", at, 2, 256, true),
                           count = *whole(packed, "count", at, 1, mostBytes, true);
        const bool vertices = mode == "ATTRIBUTES";
        const auto expectStride = [&](bool right, const char* expected) {
            if (!right)
                fail(join(at, "byteStride"), format("expected {}, found {}", expected, stride));
        };
        if (vertices)
            expectStride(stride % 4 == 0, "a multiple of 4 where vertices are compressed");
        else
            expectStride(stride == 2 || stride == 4, "2 or 4 where indices are compressed");
        if (filter == "OCTAHEDRAL")
            expectStride(stride == 4 || stride == 8, "4 or 8 of an octahedral filter");
        if (filter == "QUATERNION")
            expectStride(stride == 8, "8 of a quaternion filter");
        if (!vertices && filter != "NONE")
            wrong(join(at, "filter"), "none where indices are compressed", packed.at("filter"));
        if (mode == "TRIANGLES" && count % 3 != 0)
            fail(join(at, "count"), format("expected three indices a triangle, found {}", count));
        if (count * stride < unpacked)
            fail(join(at, "count"), format("expected the {} bytes of its buffer view, found {} "
                                           "elements of {} bytes",
                                           unpacked, count, stride));
        const std::int64_t most = vertices              ? 64 * length / stride
                                  : mode == "TRIANGLES" ? 3 * length
                                                        : length;
        if (count > most)
            fail(join(at, "count"), format("expected at most the {} elements that {} compressed "
                                           "bytes can hold, found {}",
                                           most, length, count));
    }

    static int bytesOf(int componentType) {
        return componentType <= 5121 ? 1 : componentType <= 5123 ? 2 : 4;
    }

    void checkAccessor(const json& accessor, const std::string& at) const {
        oneOf(accessor, "componentType", at, {5120, 5121, 5122, 5123, 5125, 5126}, true);
        oneOf(accessor, "type", at, {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"},
              true);
        flag(accessor, "normalized", at);
        const std::int64_t count = *whole(accessor, "count", at, 1, mostBytes, true);
        for (const char* key : {"min", "max"})
            if (const json* limits = find(accessor, key, at); limits && !limits->is_array())
                wrong(join(at, key), "an array of numbers", *limits);
        static const std::map<std::string, int> components = {
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
            {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
        const int size = bytesOf(accessor.at("componentType")) *
                         components.at(accessor.at("type").get<std::string>());
        if (find(accessor, "bufferView", at))
            checkWithin(accessor, at, count, size);
        else
            whole(accessor, "byteOffset", at, 0, mostBytes);
        if (const json* sparse = object(accessor, "sparse", at))
            checkSparse(*sparse, join(at, "sparse"), count, size);
    }

    void checkWithin(const json& part, const std::string& at, std::int64_t count, int size) const {
        const std::size_t view = *index(part, "bufferView", at, "bufferViews", true);
        const std::int64_t offset = whole(part, "byteOffset", at, 0, mostBytes).value_or(0),
                           length = lengthOf("bufferViews", view);
        const json& viewObject = root().at("bufferViews")[view];
        const std::int64_t stride =
            whole(viewObject, "byteStride", format("bufferViews[{}]", view), 4, 252).value_or(size);
        if (stride < size)
            fail(format("bufferViews[{}].byteStride", view),
                 format("expected at least the {} bytes of an element of {}, found {}", size, at,
                        stride));
        if (offset + (count - 1) * stride + size > length)
            fail(join(at, "count"),
                 format("expected what fits into the {} bytes of bufferViews[{}] from {}, found {} "
                        "elements of {} bytes, {} apart",
                        length, view, offset, count, size, stride));
    }

    void checkSparse(const json& sparse, const std::string& at, std::int64_t count,
                     int size) const {
        const std::int64_t replaced = *whole(sparse, "count", at, 1, count, true);
        for (const char* key : {"indices", "values"}) {
            const json* part = object(sparse, key, at);
            if (!part)
                fail(at, format("expected \"{}\", found none", key));
            const bool indices = std::string(key) == "indices";
            if (indices)
                oneOf(*part, "componentType", join(at, key), {5121, 5123, 5125}, true);
            checkWithin(*part, join(at, key), replaced,
                        indices ? bytesOf(part->at("componentType")) : size);
        }
    }

    // Meshes and nodes --------------------------------------------------------------------------

    void checkAttributes(const json& attributes, const std::string& at) const {
        if (!attributes.is_object())
            wrong(at, "an object of accessors", attributes);
        for (const auto& [name, value] : attributes.items())
            index(value, join(at, name), "accessors");
    }

    void checkMesh(const json& mesh, const std::string& at) const {
        text(mesh, "name", at);
        const json* primitives = find(mesh, "primitives", at, true);
        if (!primitives->is_array() || primitives->empty())
            wrong(join(at, "primitives"), "an array of at least one", *primitives);
        each(*primitives, join(at, "primitives"),
             [&](const json& o, const std::string& within) { checkPrimitive(o, within); });
        checkWeights(mesh, mesh, at);
    }

    void checkPrimitive(const json& primitive, const std::string& at) const {
        const json& attributes = *find(primitive, "attributes", at, true);
        checkAttributes(attributes, join(at, "attributes"));
        whole(primitive, "mode", at, 0, 6);
        index(primitive, "indices", at, "accessors");
        index(primitive, "material", at, "materials");
        if (const json* targets = find(primitive, "targets", at))
            each(*targets, join(at, "targets"),
                 [&](const json& o, const std::string& within) { checkAttributes(o, within); });
        if (const json* packed = extension(primitive, "KHR_draco_mesh_compression", at))
            checkDraco(*packed, extensionPath(at, "KHR_draco_mesh_compression"), attributes);
    }

    void checkDraco(const json& packed, const std::string& at, const json& attributes) const {
        index(packed, "bufferView", at, "bufferViews", true);
        const json* ids = object(packed, "attributes", at);
        if (!ids)
            fail(at, "expected \"attributes\", found none");
        for (const auto& [name, id] : ids->items()) {
            whole(*ids, name.c_str(), join(at, "attributes"), 0, 0xffffffff);
            if (!attributes.contains(name))
                fail(join(join(at, "attributes"), name),
                     "expected an attribute of the primitive, found one that it lacks");
        }
    }

    // Morph weights of a mesh, by itself or by a node: one for each target.
    void checkWeights(const json& holder, const json& mesh, const std::string& at) const {
        const json& primitive = mesh.at("primitives")[0];
        const std::size_t targets =
            primitive.contains("targets") ? primitive.at("targets").size() : 0;
        numbers(holder, "weights", at, targets);
    }

    void checkNode(const json& node, const std::string& at) const {
        text(node, "name", at);
        const auto mesh = index(node, "mesh", at, "meshes");
        if (mesh)
            checkWeights(node, root().at("meshes")[*mesh], at);
        index(node, "skin", at, "skins");
        index(node, "camera", at, "cameras");
        indices(node, "children", at, "nodes");
        numbers(node, "matrix", at, 16);
        numbers(node, "translation", at, 3);
        numbers(node, "scale", at, 3);
        const std::vector<double> q = numbers(node, "rotation", at, 4);
        if (!q.empty() && !(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 1e-12))
            wrong(join(at, "rotation"), "a unit quaternion", node.at("rotation"));
        if (const json* instances = extension(node, "EXT_mesh_gpu_instancing", at)) {
            const std::string within = extensionPath(at, "EXT_mesh_gpu_instancing");
            checkAttributes(*find(*instances, "attributes", within, true),
                            join(within, "attributes"));
        }
        if (const json* light = extension(node, "KHR_lights_punctual", at)) {
            const std::string within = extensionPath(at, "KHR_lights_punctual");
            const json* lights = extension(root(), "KHR_lights_punctual", "");
            index(*find(*light, "light", within, true), join(within, "light"),
                  extensionPath("", "KHR_lights_punctual") + ".lights",
                  lights ? lights->at("lights").size() : 0);
        }
    }

    // Cameras and lights ------------------------------------------------------------------------

    void checkCamera(const json& camera, const std::string& at) const {
        text(camera, "name", at);
        oneOf(camera, "type", at, {"perspective", "orthographic"}, true);
        if (camera.at("type") != "perspective")
            return;
        const json* perspective = object(camera, "perspective", at);
        if (!perspective)
            fail(at, "expected \"perspective\", found none");
        for (const char* key : {"yfov", "znear"}) {
            find(*perspective, key, join(at, "perspective"), true);
            number(*perspective, key, join(at, "perspective"), 1e-9, 1e15);
        }
    }

    void checkLights() const {
        const json* lights = extension(root(), "KHR_lights_punctual", "");
        if (!lights)
            return;
        const std::string at = extensionPath("", "KHR_lights_punctual");
        each(*find(*lights, "lights", at, true), join(at, "lights"),
             [&](const json& o, const std::string& within) { checkLight(o, within); });
    }

    void checkLight(const json& light, const std::string& at) const {
        oneOf(light, "type", at, {"directional", "point", "spot"}, true);
        numbers(light, "color", at, 3);
        number(light, "intensity", at, 0, 1e15);
        number(light, "range", at, 0, 1e15);
        const json* spot = object(light, "spot", at);
        if (!spot)
            return;
        number(*spot, "innerConeAngle", join(at, "spot"), 0, std::numbers::pi / 2);
        number(*spot, "outerConeAngle", join(at, "spot"), 0, std::numbers::pi / 2 + 1e-6);
    }
};

} // namespace

void checkGltf(const json& root, const std::filesystem::path& file) {
    const GltfJson values(root, file);
    if (!root.is_object())
        values.wrong("", "a JSON object, the root of a glTF file", root);
    Checker(root, file).run();
}

} // namespace obscura
