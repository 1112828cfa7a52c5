#include "renderer/scene/gltf_check_materials.h"

#include <fmt/format.h>

namespace obscura {

using fmt::format;
using nlohmann::json;

namespace {

class Checker : private GltfJson {
  public:
    explicit Checker(const GltfJson& values) : GltfJson(values) {}

    void run() const {
        each("images", [&](const json& o, const std::string& at) { checkImage(o, at); });
        each("samplers", [&](const json& o, const std::string& at) { checkSampler(o, at); });
        each("textures", [&](const json& o, const std::string& at) { checkTexture(o, at); });
        each("materials", [&](const json& o, const std::string& at) { checkMaterial(o, at); });
    }

  private:
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
            oneOf(sampler, key, at, {10497, 33071, 33648});
        oneOf(sampler, "magFilter", at, {9728, 9729});
        oneOf(sampler, "minFilter", at, {9728, 9729, 9984, 9985, 9986, 9987});
    }

    void checkTexture(const json& texture, const std::string& at) const {
        index(texture, "source", at, "images");
        index(texture, "sampler", at, "samplers");
        if (const json* webp = extension(texture, "EXT_texture_webp", at))
            index(*webp, "source", extensionPath(at, "EXT_texture_webp"), "images", true);
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
        oneOf(material, "alphaMode", at, {"OPAQUE", "MASK", "BLEND"});
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
};

} // namespace

void checkGltfMaterials(const GltfJson& values) { Checker(values).run(); }

} // namespace obscura
