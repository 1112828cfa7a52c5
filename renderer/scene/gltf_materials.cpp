#include "renderer/scene/gltf_materials.h"

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/scene/gltf_check.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstdint>

namespace obscura {

using fmt::format;

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

// OpenImageIO looks at contents, but asks a name for the format first.
std::string extensionOf(std::span<const std::byte> encoded) {
    const auto begins = [&](std::initializer_list<int> bytes) {
        return encoded.size() >= bytes.size() &&
               std::equal(bytes.begin(), bytes.end(), encoded.begin(),
                          [](int a, std::byte b) { return static_cast<std::byte>(a) == b; });
    };
    return begins({0x89, 'P', 'N', 'G'}) ? ".png" : begins({0xff, 0xd8}) ? ".jpg" : "";
}

} // namespace

GltfMaterials::GltfMaterials(const GltfFile& file, const tinygltf::Model& model, Warn warn)
    : file_(file), model_(model), warn_(std::move(warn)) {}

std::vector<Material> GltfMaterials::materials() {
    std::vector<Material> result;
    for (std::size_t i = 0; i < model_.materials.size(); ++i)
        result.push_back(convert(model_.materials[i], format("materials[{}]", i)));
    return result;
}

int GltfMaterials::textureOf(int index, int coordinates, bool colour, const std::string& material,
                             const std::string& at) {
    if (index < 0)
        return -1;
    if (coordinates != coordinates_.back()) {
        warn_(
            format("material \"{}\": its texture {} wants texture coordinates {} where its others "
                   "have {}; it is left out",
                   material, at, coordinates, coordinates_.back()));
        return -1;
    }
    const tinygltf::Texture& texture = model_.textures[static_cast<std::size_t>(index)];
    if (texture.source < 0)
        failGltf(file_.path(), format("textures[{}].source", index),
                 "expected an image, found none; an extension may hold one that is not supported "
                 "(KTX2 or WebP): export PNG or JPEG as well");
    const auto [known, added] = known_.try_emplace({texture.source, texture.sampler, colour},
                                                   static_cast<int>(known_.size()));
    return known->second;
}

Material GltfMaterials::convert(const tinygltf::Material& from, const std::string& at) {
    Material to;
    to.name = from.name;
    const auto& pbr = from.pbrMetallicRoughness;
    coordinates_.push_back(pbr.baseColorTexture.index >= 0 ? pbr.baseColorTexture.texCoord
                           : from.normalTexture.index >= 0 ? from.normalTexture.texCoord
                                                           : pbr.metallicRoughnessTexture.texCoord);
    const auto texture = [&](const auto& info, bool colour, const char* key) {
        return textureOf(info.index, info.texCoord, colour, from.name.empty() ? at : from.name,
                         key);
    };
    to.baseColour = glm::vec4(glm::make_vec4(pbr.baseColorFactor.data()));
    to.baseColourTexture = texture(pbr.baseColorTexture, true, "baseColorTexture");
    to.metallic = static_cast<float>(pbr.metallicFactor);
    to.roughness = static_cast<float>(pbr.roughnessFactor);
    to.metallicRoughnessTexture =
        texture(pbr.metallicRoughnessTexture, false, "metallicRoughnessTexture");
    to.normalTexture = texture(from.normalTexture, false, "normalTexture");
    to.normalScale = static_cast<float>(from.normalTexture.scale);
    to.doubleSided = from.doubleSided;
    if (from.alphaMode == "MASK")
        to.alphaCutoff = std::max(static_cast<float>(from.alphaCutoff), 1e-6f);
    if (from.alphaMode == "BLEND")
        warn_(format("material \"{}\" is translucent; it is drawn opaque", from.name));
    if (from.occlusionTexture.index >= 0)
        warn_("baked occlusion textures are left out: they would stand in for the technique");
    if (from.emissiveTexture.index >= 0 ||
        *std::max_element(from.emissiveFactor.begin(), from.emissiveFactor.end()) > 0)
        warn_(format("material \"{}\" emits light; emission is left out", from.name));
    return to;
}

Texture GltfMaterials::decode(const Key& key) const {
    const auto& [image, sampler, colour] = key;
    const auto index = static_cast<std::size_t>(image);
    const auto encoded = file_.image(index);
    Texture result;
    result.srgb = colour;
    try {
        result.image = readImage8(encoded, file_.imageName(index) + extensionOf(encoded), 4);
    } catch (const Error& error) {
        failGltf(file_.path(), format("images[{}]", image), error.what());
    }
    if (sampler < 0)
        return result;
    const auto& from = model_.samplers[static_cast<std::size_t>(sampler)];
    result.wrapU = wrapOf(from.wrapS);
    result.wrapV = wrapOf(from.wrapT);
    result.nearest = from.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
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
