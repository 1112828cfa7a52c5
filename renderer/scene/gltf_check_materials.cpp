#include "renderer/scene/gltf_check_materials.h"

#include <fmt/format.h>

namespace obscura {

using fmt::format;
using nlohmann::json;

namespace {

class MaterialChecker : private GltfJson {
  public:
    explicit MaterialChecker(const GltfJson& values) : GltfJson(values) {}

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
        const std::string within = join(at, key);
        index(*info, "index", within, "textures", true);
        whole(*info, "texCoord", within, 0, 31);
        number(*info, "scale", within, -1e6, 1e6);
        number(*info, "strength", within, -1e6, 1e6);
        if (const json* transform = extension(*info, "KHR_texture_transform", within))
            checkTransform(*transform, extensionPath(within, "KHR_texture_transform"));
    }
    void checkTransform(const json& transform, const std::string& at) const {
        vector(transform, "offset", at, 2, -1e6, 1e6);
        vector(transform, "scale", at, 2, -1e6, 1e6);
        number(transform, "rotation", at, -1e6, 1e6);
        whole(transform, "texCoord", at, 0, 31);
    }

    // So many numbers, each within bounds.
    void vector(const json& object, const char* key, const std::string& at, std::size_t count,
                double least, double most) const {
        for (const double each : numbers(object, key, at, count))
            if (each < least || each > most)
                wrong(join(at, key), format("numbers from {:g} to {:g}", least, most),
                      object.at(key));
    }

    void checkGlossiness(const json& glossy, const std::string& at) const {
        vector(glossy, "diffuseFactor", at, 4, -1e6, 1e6);
        vector(glossy, "specularFactor", at, 3, 0, 1);
        number(glossy, "glossinessFactor", at, 0, 1);
        for (const char* key : {"diffuseTexture", "specularGlossinessTexture"})
            checkTextureInfo(glossy, key, at);
    }
    void checkMaterialExtensions(const json& material, const std::string& at) const {
        extension(material, "KHR_materials_unlit", at);
        const char* name = "KHR_materials_emissive_strength";
        if (const json* strong = extension(material, name, at))
            number(*strong, "emissiveStrength", extensionPath(at, name), 0, 1e6);
        name = "KHR_materials_pbrSpecularGlossiness";
        if (const json* glossy = extension(material, name, at))
            checkGlossiness(*glossy, extensionPath(at, name));
    }

    void checkMaterial(const json& material, const std::string& at) const {
        text(material, "name", at);
        oneOf(material, "alphaMode", at, {"OPAQUE", "MASK", "BLEND"});
        number(material, "alphaCutoff", at, 0, 1e6);
        flag(material, "doubleSided", at);
        vector(material, "emissiveFactor", at, 3, 0, 1e6);
        for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
            checkTextureInfo(material, key, at);
        checkMaterialExtensions(material, at);
        const json* pbr = object(material, "pbrMetallicRoughness", at);
        if (!pbr)
            return;
        const std::string within = join(at, "pbrMetallicRoughness");
        vector(*pbr, "baseColorFactor", within, 4, -1e6, 1e6);
        number(*pbr, "metallicFactor", within, 0, 1);
        number(*pbr, "roughnessFactor", within, 0, 1);
        for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"})
            checkTextureInfo(*pbr, key, within);
    }
};

} // namespace

void checkGltfMaterials(const GltfJson& values) { MaterialChecker(values).run(); }

} // namespace obscura
