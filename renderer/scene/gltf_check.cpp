#include "renderer/scene/gltf_check.h"

#include "base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace obscura {

using fmt::format;
using nlohmann::json;

namespace {

// Whole numbers in JSON are exact up to here, and no file that we read is longer.
constexpr std::int64_t mostBytes = 0x7fffffff;
// Nothing in a scene is further away, and no product of two such numbers overflows a float.
constexpr double largest = 1e15;

// What stands at a place, short enough for a line.
std::string spelt(const json& value) {
    std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    return text.size() > 40 ? text.substr(0, 40) + "..." : text;
}

class Checker {
  public:
    Checker(const json& root, const std::filesystem::path& file) : root_(root), file_(file) {}

    void run() {
        checkAsset();
        checkExtensions();
        for (const char* name :
             {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials",
              "meshes", "nodes", "samplers", "scenes", "skins", "textures"})
            checkArray(name);
        each("buffers", [&](const json& buffer, const std::string& at) {
            whole(buffer, "byteLength", at, 1, mostBytes, true);
            text(buffer, "uri", at);
        });
        each("bufferViews", [&](const json& o, const std::string& at) { checkView(o, at); });
        each("accessors", [&](const json& o, const std::string& at) { checkAccessor(o, at); });
        each("images", [&](const json& o, const std::string& at) { checkImage(o, at); });
        each("samplers", [&](const json& o, const std::string& at) { checkSampler(o, at); });
        each("textures", [&](const json& texture, const std::string& at) {
            index(texture, "source", at, "images");
            index(texture, "sampler", at, "samplers");
        });
        each("materials", [&](const json& o, const std::string& at) { checkMaterial(o, at); });
        each("meshes", [&](const json& o, const std::string& at) { checkMesh(o, at); });
        each("nodes", [&](const json& o, const std::string& at) { checkNode(o, at); });
        each("skins", [&](const json& skin, const std::string& at) {
            indices(skin, "joints", at, "nodes");
            index(skin, "inverseBindMatrices", at, "accessors");
            index(skin, "skeleton", at, "nodes");
        });
        each("scenes", [&](const json& scene, const std::string& at) {
            indices(scene, "nodes", at, "nodes");
        });
        index(root_, "scene", "", "scenes");
    }

  private:
    [[noreturn]] void fail(const std::string& at, const std::string& message) const {
        failGltf(file_, at, message);
    }
    [[noreturn]] void wrong(const std::string& at, const std::string& expected,
                            const json& found) const {
        fail(at, format("expected {}, found {}", expected, spelt(found)));
    }

    static std::string join(const std::string& at, const std::string& key) {
        return at.empty() ? key : at + "." + key;
    }

    // Null where an optional key is missing.
    const json* find(const json& object, const char* key, const std::string& at,
                     bool required = false) const {
        const auto found = object.find(key);
        if (found != object.end())
            return &*found;
        if (required)
            fail(at.empty() ? "(root)" : at, format("expected \"{}\", found none", key));
        return nullptr;
    }

    std::optional<std::int64_t> whole(const json& object, const char* key, const std::string& at,
                                      std::int64_t least, std::int64_t most,
                                      bool required = false) const {
        const json* value = find(object, key, at, required);
        if (!value)
            return std::nullopt;
        // Some writers say 3.0.
        const bool isWhole =
            value->is_number() && std::floor(value->get<double>()) == value->get<double>();
        if (!isWhole || value->get<double>() < static_cast<double>(least) ||
            value->get<double>() > static_cast<double>(most))
            wrong(join(at, key), format("a whole number from {} to {}", least, most), *value);
        return static_cast<std::int64_t>(value->get<double>());
    }

    double number(const json& value, const std::string& at) const {
        if (!value.is_number() || !(std::abs(value.get<double>()) <= largest))
            wrong(at, format("a number within {:g}", largest), value);
        return value.get<double>();
    }
    std::optional<double> number(const json& object, const char* key, const std::string& at,
                                 double least, double most) const {
        const json* value = find(object, key, at);
        if (!value)
            return std::nullopt;
        const double found = number(*value, join(at, key));
        if (found < least || found > most)
            wrong(join(at, key), format("a number from {:g} to {:g}", least, most), *value);
        return found;
    }
    std::vector<double> numbers(const json& object, const char* key, const std::string& at,
                                std::size_t count) const {
        const json* value = find(object, key, at);
        if (!value)
            return {};
        if (!value->is_array() || value->size() != count)
            wrong(join(at, key), format("{} numbers", count), *value);
        std::vector<double> result;
        for (const json& each : *value)
            result.push_back(number(each, join(at, key)));
        return result;
    }

    std::optional<std::string> text(const json& object, const char* key,
                                    const std::string& at) const {
        const json* value = find(object, key, at);
        if (!value)
            return std::nullopt;
        if (!value->is_string())
            wrong(join(at, key), "text", *value);
        return value->get<std::string>();
    }
    void flag(const json& object, const char* key, const std::string& at) const {
        const json* value = find(object, key, at);
        if (value && !value->is_boolean())
            wrong(join(at, key), "true or false", *value);
    }
    template <typename T>
    void oneOf(const json& object, const char* key, const std::string& at,
               const std::vector<T>& allowed, bool required = false) const {
        const json* value = find(object, key, at, required);
        if (value && std::find(allowed.begin(), allowed.end(), *value) == allowed.end())
            wrong(join(at, key), format("one of {}", fmt::join(allowed, ", ")), *value);
    }
    const json* object(const json& parent, const char* key, const std::string& at) const {
        const json* value = find(parent, key, at);
        if (value && !value->is_object())
            wrong(join(at, key), "an object", *value);
        return value;
    }

    std::size_t sizeOf(const char* array) const {
        const auto found = root_.find(array);
        return found == root_.end() ? 0 : found->size();
    }
    std::size_t index(const json& value, const std::string& at, const char* array) const {
        const std::size_t size = sizeOf(array);
        if (!value.is_number_integer() || value.get<double>() < 0 ||
            value.get<double>() >= static_cast<double>(size))
            wrong(at,
                  size == 0 ? format("an index into {}, of which there are none", array)
                            : format("an index into {}, 0 to {}", array, size - 1),
                  value);
        return value.get<std::size_t>();
    }
    std::optional<std::size_t> index(const json& object, const char* key, const std::string& at,
                                     const char* array, bool required = false) const {
        const json* value = find(object, key, at, required);
        return value ? std::optional(index(*value, join(at, key), array)) : std::nullopt;
    }
    void indices(const json& object, const char* key, const std::string& at,
                 const char* array) const {
        const json* value = find(object, key, at);
        if (!value)
            return;
        if (!value->is_array())
            wrong(join(at, key), format("an array of indices into {}", array), *value);
        for (std::size_t i = 0; i < value->size(); ++i)
            index((*value)[i], format("{}[{}]", join(at, key), i), array);
    }

    void checkArray(const char* name) const {
        const json* array = find(root_, name, "");
        if (!array)
            return;
        if (!array->is_array())
            wrong(name, "an array", *array);
        for (std::size_t i = 0; i < array->size(); ++i)
            if (!(*array)[i].is_object())
                wrong(format("{}[{}]", name, i), "an object", (*array)[i]);
    }
    template <typename Check>
    void each(const char* name, const Check& check) const {
        for (std::size_t i = 0; i < sizeOf(name); ++i)
            check(root_.at(name)[i], format("{}[{}]", name, i));
    }

    void checkAsset() const {
        const json* asset = object(root_, "asset", "");
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

    void checkExtensions() const {
        static const std::set<std::string> shown = {"KHR_mesh_quantization"};
        static const std::map<std::string, std::string> hints = {
            {"KHR_draco_mesh_compression", "its meshes are compressed; export without Draco"},
            {"EXT_meshopt_compression", "its meshes are compressed; export without meshopt"},
            {"KHR_texture_basisu", "its textures are KTX2; export PNG or JPEG"},
            {"EXT_texture_webp", "its textures are WebP; export PNG or JPEG"},
        };
        for (const char* key : {"extensionsRequired", "extensionsUsed"}) {
            const json* names = find(root_, key, "");
            if (!names)
                continue;
            if (!names->is_array())
                wrong(key, "an array of names", *names);
            for (std::size_t i = 0; i < names->size(); ++i)
                if (!(*names)[i].is_string())
                    wrong(format("{}[{}]", key, i), "a name", (*names)[i]);
        }
        const json* required = find(root_, "extensionsRequired", "");
        for (std::size_t i = 0; required && i < required->size(); ++i) {
            const auto name = (*required)[i].get<std::string>();
            const auto hint = hints.find(name);
            if (!shown.contains(name))
                fail(format("extensionsRequired[{}]", i),
                     format("the scene requires the extension {}, which is not supported: {}", name,
                            hint == hints.end() ? "export without it" : hint->second));
        }
    }

    void checkView(const json& view, const std::string& at) const {
        const std::size_t buffer = *index(view, "buffer", at, "buffers", true);
        const std::int64_t offset = whole(view, "byteOffset", at, 0, mostBytes).value_or(0),
                           length = *whole(view, "byteLength", at, 1, mostBytes, true),
                           whole = lengthOf("buffers", buffer);
        if (offset + length > whole)
            fail(at, format("expected a view within the {} bytes of buffers[{}], found {} bytes "
                            "from {}",
                            whole, buffer, length, offset));
        const auto stride = this->whole(view, "byteStride", at, 4, 252);
        if (stride && *stride % 4 != 0)
            fail(join(at, "byteStride"), format("expected a multiple of 4, found {}", *stride));
    }
    std::int64_t lengthOf(const char* array, std::size_t i) const {
        return static_cast<std::int64_t>(root_.at(array)[i].at("byteLength").get<double>());
    }

    static int bytesOf(int componentType) {
        return componentType <= 5121 ? 1 : componentType <= 5123 ? 2 : 4;
    }

    void checkAccessor(const json& accessor, const std::string& at) const {
        oneOf<int>(accessor, "componentType", at, {5120, 5121, 5122, 5123, 5125, 5126}, true);
        oneOf<std::string>(accessor, "type", at,
                           {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}, true);
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
        const json& viewObject = root_.at("bufferViews")[view];
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
                oneOf<int>(*part, "componentType", join(at, key), {5121, 5123, 5125}, true);
            checkWithin(*part, join(at, key), replaced,
                        indices ? bytesOf(part->at("componentType")) : size);
        }
    }

    void checkImage(const json& image, const std::string& at) const {
        text(image, "name", at);
        text(image, "mimeType", at);
        const bool uri = text(image, "uri", at).has_value(),
                   view = index(image, "bufferView", at, "bufferViews").has_value();
        if (uri == view)
            fail(at,
                 format("expected either a uri or a bufferView, found {}", uri ? "both" : "none"));
    }

    void checkSampler(const json& sampler, const std::string& at) const {
        for (const char* key : {"wrapS", "wrapT"})
            oneOf<int>(sampler, key, at, {10497, 33071, 33648});
        oneOf<int>(sampler, "magFilter", at, {9728, 9729});
        oneOf<int>(sampler, "minFilter", at, {9728, 9729, 9984, 9985, 9986, 9987});
    }

    void checkTextureInfo(const json& parent, const char* key, const std::string& at) const {
        const json* info = object(parent, key, at);
        if (!info)
            return;
        index(*info, "index", join(at, key), "textures", true);
        whole(*info, "texCoord", join(at, key), 0, 31);
        number(*info, "scale", join(at, key), -1e6, 1e6);
        number(*info, "strength", join(at, key), -1e6, 1e6);
    }
    void checkMaterial(const json& material, const std::string& at) const {
        text(material, "name", at);
        oneOf<std::string>(material, "alphaMode", at, {"OPAQUE", "MASK", "BLEND"});
        number(material, "alphaCutoff", at, 0, 1e6);
        flag(material, "doubleSided", at);
        numbers(material, "emissiveFactor", at, 3);
        for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
            checkTextureInfo(material, key, at);
        const json* pbr = object(material, "pbrMetallicRoughness", at);
        if (!pbr)
            return;
        const std::string within = join(at, "pbrMetallicRoughness");
        numbers(*pbr, "baseColorFactor", within, 4);
        number(*pbr, "metallicFactor", within, 0, 1);
        number(*pbr, "roughnessFactor", within, 0, 1);
        for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"})
            checkTextureInfo(*pbr, key, within);
    }

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
        for (std::size_t i = 0; i < primitives->size(); ++i) {
            const json& primitive = (*primitives)[i];
            const std::string within = format("{}.primitives[{}]", at, i);
            if (!primitive.is_object())
                wrong(within, "an object", primitive);
            checkAttributes(*find(primitive, "attributes", within, true), within + ".attributes");
            whole(primitive, "mode", within, 0, 6);
            index(primitive, "indices", within, "accessors");
            index(primitive, "material", within, "materials");
            const json* targets = find(primitive, "targets", within);
            if (targets && !targets->is_array())
                wrong(within + ".targets", "an array", *targets);
            for (std::size_t t = 0; targets && t < targets->size(); ++t)
                checkAttributes((*targets)[t], format("{}.targets[{}]", within, t));
        }
    }

    void checkNode(const json& node, const std::string& at) const {
        text(node, "name", at);
        index(node, "mesh", at, "meshes");
        index(node, "skin", at, "skins");
        index(node, "camera", at, "cameras");
        indices(node, "children", at, "nodes");
        numbers(node, "matrix", at, 16);
        numbers(node, "translation", at, 3);
        numbers(node, "scale", at, 3);
        const std::vector<double> q = numbers(node, "rotation", at, 4);
        if (!q.empty() && !(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 1e-12))
            wrong(join(at, "rotation"), "a unit quaternion", node.at("rotation"));
    }

    const json& root_;
    const std::filesystem::path& file_;
};

} // namespace

void failGltf(const std::filesystem::path& file, const std::string& jsonPath,
              const std::string& message) {
    throw Error({file.string(), 0, 0, jsonPath}, message);
}

void checkGltf(const json& root, const std::filesystem::path& file) {
    if (!root.is_object())
        failGltf(file, "", "expected a JSON object, the root of a glTF file, found " + spelt(root));
    Checker(root, file).run();
}

} // namespace obscura
