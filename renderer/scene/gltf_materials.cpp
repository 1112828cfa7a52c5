#include "renderer/scene/gltf_materials.h"

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/scene/gltf_check.h"
#include "renderer/scene/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace obscura {

using fmt::format;
using nlohmann::json;

namespace {

// Decoded, of all textures together: 4 GiB.
constexpr std::int64_t mostTexels = std::int64_t{1} << 30;

Wrap wrapOf(int mode) {
    switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::mirrored;
    default:
        return Wrap::repeat;
    }
}

// As many numbers as a vector of this kind has.
template <typename Vec>
Vec vec(const json& object, const char* key, Vec result) {
    const auto found = object.find(key);
    for (int i = 0; found != object.end() && i < Vec::length(); ++i)
        result[i] = (*found)[static_cast<std::size_t>(i)].template get<float>();
    return result;
}

// Trilinear where the file does not say.
Minified minifiedOf(int filter) {
    switch (filter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
        return Minified::nearest;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
        return Minified::linear;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
        return Minified::nearestMipmapNearest;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
        return Minified::linearMipmapNearest;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
        return Minified::nearestMipmapLinear;
    default:
        return Minified::linearMipmapLinear;
    }
}

// OpenImageIO looks at contents, but asks a name for the format first.
std::string formatOf(std::span<const std::byte> encoded) {
    const auto has = [&](std::size_t at, std::initializer_list<int> bytes) {
        return encoded.size() >= at + bytes.size() &&
               std::equal(bytes.begin(), bytes.end(), encoded.begin() + static_cast<long>(at),
                          [](int a, std::byte b) { return static_cast<std::byte>(a) == b; });
    };
    return has(0, {0x89, 'P', 'N', 'G'})  ? ".png"
           : has(0, {0xff, 0xd8})         ? ".jpg"
           : has(8, {'W', 'E', 'B', 'P'}) ? ".webp"
                                          : "";
}

} // namespace

GltfMaterials::GltfMaterials(const GltfFile& file, const tinygltf::Model& model, Warn warn)
    : file_(file), model_(model), warn_(std::move(warn)) {}

std::vector<Material> GltfMaterials::materials() {
    std::vector<Material> result;
    for (const json& material : file_.root().value("materials", json::array()))
        result.push_back(convert(material));
    return result;
}

int GltfMaterials::textureOf(int index, bool colour) {
    const json& texture = file_.root().at("textures")[static_cast<std::size_t>(index)];
    const json* webp = extensionOf(texture, "EXT_texture_webp");
    const int source = webp ? webp->at("source").get<int>() : texture.value("source", -1);
    if (source < 0)
        failGltf(file_.path(), format("textures[{}].source", index),
                 "expected an image, found none; an extension may hold one that is not supported "
                 "(KTX2): export PNG, JPEG or WebP as well");
    return known_
        .try_emplace({source, texture.value("sampler", -1), colour},
                     static_cast<int>(known_.size()))
        .first->second;
}

TextureUse GltfMaterials::use(const json& parent, const char* key, bool colour,
                              const Material& material) {
    const auto found = parent.find(key);
    if (found == parent.end())
        return {};
    TextureUse result;
    int set = found->value("texCoord", 0);
    if (const json* transform = extensionOf(*found, "KHR_texture_transform")) {
        result.offset = vec(*transform, "offset", glm::vec2(0));
        result.scale = vec(*transform, "scale", glm::vec2(1));
        result.rotation = transform->value("rotation", 0.0f);
        set = transform->value("texCoord", set);
    }
    auto& [first, second] = coordinates_.back();
    if (first < 0 || first == set) {
        first = set;
    } else if (second < 0 || second == set) {
        second = set;
        result.set = 1;
    } else {
        warn_(format("material \"{}\": its {} wants texture coordinates {} where its others have "
                     "{} and {}; it is left out",
                     material.name, key, set, first, second));
        return {};
    }
    result.texture = textureOf(found->at("index").get<int>(), colour);
    return result;
}

// What the surface reflects, by one of glTF's two models.
void GltfMaterials::readReflectance(const json& from, Material& to) {
    if (const json* glossy = extensionOf(from, "KHR_materials_pbrSpecularGlossiness");
        glossy && !to.unlit) {
        to.baseColour = vec(*glossy, "diffuseFactor", glm::vec4(1));
        to.baseColourTexture = use(*glossy, "diffuseTexture", true, to);
        to.specularGlossiness = {vec(*glossy, "specularFactor", glm::vec3(1)),
                                 glossy->value("glossinessFactor", 1.0f)};
        to.metallicRoughnessTexture = use(*glossy, "specularGlossinessTexture", true, to);
        return;
    }
    const json pbr = from.value("pbrMetallicRoughness", json::object());
    to.baseColour = vec(pbr, "baseColorFactor", glm::vec4(1));
    to.baseColourTexture = use(pbr, "baseColorTexture", true, to);
    to.metallic = pbr.value("metallicFactor", 1.0f);
    to.roughness = pbr.value("roughnessFactor", 1.0f);
    if (!to.unlit)
        to.metallicRoughnessTexture = use(pbr, "metallicRoughnessTexture", false, to);
}

void GltfMaterials::readEmission(const json& from, Material& to) {
    const json* strong = extensionOf(from, "KHR_materials_emissive_strength");
    to.emission = vec(from, "emissiveFactor", glm::vec3(0)) *
                  (strong ? strong->value("emissiveStrength", 1.0f) : 1.0f);
    if (to.emits())
        to.emissionTexture = use(from, "emissiveTexture", true, to);
}

void GltfMaterials::warnOfAbsent(const json& from, const Material& to) const {
    if (from.value("alphaMode", "") == "BLEND")
        warn_(format("material \"{}\" is translucent; it is drawn opaque", to.name));
    if (from.contains("occlusionTexture"))
        warn_("baked occlusion textures are left out: they would stand in for the technique");
}

Material GltfMaterials::convert(const json& from) {
    Material to;
    to.name = from.value("name", format("materials[{}]", coordinates_.size()));
    coordinates_.push_back({-1, -1});
    to.unlit = extensionOf(from, "KHR_materials_unlit") != nullptr;
    to.doubleSided = from.value("doubleSided", false);
    if (from.value("alphaMode", "") == "MASK")
        to.alphaCutoff = std::max(from.value("alphaCutoff", 0.5f), 1e-6f);
    readReflectance(from, to);
    if (!to.unlit) { // which leaves nothing but the base colour
        to.normalTexture = use(from, "normalTexture", false, to);
        if (to.normalTexture.exists())
            to.normalScale = from.at("normalTexture").value("scale", 1.0f);
        readEmission(from, to);
    }
    warnOfAbsent(from, to);
    int& first = coordinates_.back()[0];
    first = std::max(first, 0);
    return to;
}

Texture GltfMaterials::decode(const Key& key) const {
    const auto& [image, sampler, colour] = key;
    const auto index = static_cast<std::size_t>(image);
    const auto encoded = file_.image(index);
    Texture result;
    result.srgb = colour;
    try {
        result.image = readImage8(encoded, file_.imageName(index) + formatOf(encoded), 4);
    } catch (const Error& error) {
        failGltf(file_.path(), format("images[{}]", image), error.what());
    }
    if (sampler < 0)
        return result;
    const auto& from = model_.samplers[static_cast<std::size_t>(sampler)];
    result.wrapU = wrapOf(from.wrapS);
    result.wrapV = wrapOf(from.wrapT);
    result.nearest = from.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    result.minified = minifiedOf(from.minFilter);
    return result;
}

std::vector<Texture> GltfMaterials::textures() const {
    std::vector<Texture> result(known_.size());
    const std::vector<std::pair<Key, int>> work(known_.begin(), known_.end());
    std::vector<std::string> problems(work.size());
    std::atomic<std::int64_t> texels{0};
    forEachInParallel(work.size(), [&](std::size_t i) {
        try {
            if (texels > mostTexels)
                failGltf(file_.path(), "images",
                         format("expected textures of at most {} texels together, found more",
                                mostTexels));
            Texture& texture = result[static_cast<std::size_t>(work[i].second)];
            texture = decode(work[i].first);
            texels += std::int64_t{texture.image.width} * texture.image.height;
        } catch (const std::exception& error) {
            problems[i] = error.what();
        }
    });
    for (const std::string& problem : problems)
        if (!problem.empty())
            throw Error(problem);
    return result;
}

} // namespace obscura
