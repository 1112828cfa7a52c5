#include "renderer/scene/gltf_materials.h"

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/scene/gltf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
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
std::string extensionOf(std::span<const std::byte> encoded) {
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
    for (std::size_t i = 0; i < model_.materials.size(); ++i)
        result.push_back(
            convert({file_, file_.root().at("materials")[i], format("materials[{}]", i)}));
    return result;
}

int GltfMaterials::textureOf(int index, bool colour) {
    const GltfObject texture(file_, file_.root().at("textures")[static_cast<std::size_t>(index)],
                             format("textures[{}]", index));
    std::optional<int> source = texture.index("source", "images");
    if (const auto webp = texture.extension("EXT_texture_webp"))
        source = webp->index("source", "images");
    if (!source)
        failGltf(file_.path(), texture.path() + ".source",
                 "expected an image, found none; an extension may hold one that is not supported "
                 "(KTX2): export PNG, JPEG or WebP as well");
    const int sampler = texture.index("sampler", "samplers").value_or(-1);
    return known_.try_emplace({*source, sampler, colour}, static_cast<int>(known_.size()))
        .first->second;
}

TextureUse GltfMaterials::use(const GltfObject& parent, const char* key, bool colour) {
    const auto info = parent.object(key);
    if (!info)
        return {};
    const auto index = info->index("index", "textures");
    if (!index)
        failGltf(file_.path(), info->path(), "expected \"index\", found none");
    constexpr double most = 1e6;
    TextureUse result;
    int set = info->whole("texCoord", 0, 31, 0);
    if (const auto transform = info->extension("KHR_texture_transform")) {
        const auto offset = transform->numbers<2>("offset", -most, most, {0, 0}),
                   scale = transform->numbers<2>("scale", -most, most, {1, 1});
        result.offset = {offset[0], offset[1]};
        result.scale = {scale[0], scale[1]};
        result.rotation = static_cast<float>(transform->number("rotation", -most, most, 0));
        set = transform->whole("texCoord", 0, 31, set);
    }
    Coordinates& read = coordinates_.back();
    for (result.set = 0; read[static_cast<std::size_t>(result.set)] != set; ++result.set) {
        int& free = read[static_cast<std::size_t>(result.set)];
        if (free < 0) {
            free = set;
            break;
        }
        if (result.set == 1) {
            warn_(format("{}: reads texture coordinates {} where other textures of its material "
                         "read {} and {}; it is left out",
                         info->path(), set, read[0], read[1]));
            return {};
        }
    }
    result.texture = textureOf(*index, colour);
    return result;
}

// What the surface reflects, by one of glTF's two models.
void GltfMaterials::readReflectance(const GltfObject& from, Material& to) {
    const auto colour = [&](const GltfObject& object, const char* key) {
        const auto factor = object.numbers<4>(key, -1e6, 1e6, {1, 1, 1, 1});
        return glm::vec4(factor[0], factor[1], factor[2], factor[3]);
    };
    if (const auto glossy = from.extension("KHR_materials_pbrSpecularGlossiness");
        glossy && !to.unlit) {
        const auto specular = glossy->numbers<3>("specularFactor", 0, 1, {1, 1, 1});
        to.baseColour = colour(*glossy, "diffuseFactor");
        to.baseColourTexture = use(*glossy, "diffuseTexture", true);
        to.specularGlossiness = {{specular[0], specular[1], specular[2]},
                                 static_cast<float>(glossy->number("glossinessFactor", 0, 1, 1))};
        to.metallicRoughnessTexture = use(*glossy, "specularGlossinessTexture", true);
        return;
    }
    to.metallic = 1; // glTF's default
    const auto pbr = from.object("pbrMetallicRoughness");
    if (!pbr)
        return;
    to.baseColour = colour(*pbr, "baseColorFactor");
    to.baseColourTexture = use(*pbr, "baseColorTexture", true);
    to.metallic = static_cast<float>(pbr->number("metallicFactor", 0, 1, 1));
    to.roughness = static_cast<float>(pbr->number("roughnessFactor", 0, 1, 1));
    if (!to.unlit)
        to.metallicRoughnessTexture = use(*pbr, "metallicRoughnessTexture", false);
}

void GltfMaterials::readEmission(const GltfObject& from, Material& to) {
    const auto factor = from.numbers<3>("emissiveFactor", 0, 1e6, {0, 0, 0});
    const auto strong = from.extension("KHR_materials_emissive_strength");
    to.emission = glm::vec3(factor[0], factor[1], factor[2]) *
                  static_cast<float>(strong ? strong->number("emissiveStrength", 0, 1e6, 1) : 1);
    if (to.emits())
        to.emissionTexture = use(from, "emissiveTexture", true);
}

void GltfMaterials::warnOfAbsent(const GltfObject& from, const Material& to) const {
    if (from.text("alphaMode") == "BLEND")
        warn_(format("material \"{}\" is translucent; it is drawn opaque", to.name));
    if (from.object("occlusionTexture"))
        warn_("baked occlusion textures are left out: they would stand in for the technique");
}

Material GltfMaterials::convert(const GltfObject& from) {
    Material to;
    to.name = from.text("name");
    to.unlit = from.extension("KHR_materials_unlit").has_value();
    to.doubleSided = from.flag("doubleSided");
    if (from.text("alphaMode") == "MASK")
        to.alphaCutoff =
            std::max(static_cast<float>(from.number("alphaCutoff", 0, 1e6, 0.5)), 1e-6f);
    coordinates_.push_back({-1, -1});
    readReflectance(from, to);
    if (!to.unlit) { // which ignores all but the base colour
        to.normalTexture = use(from, "normalTexture", false);
        if (const auto map = from.object("normalTexture"))
            to.normalScale = static_cast<float>(map->number("scale", -1e6, 1e6, 1));
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
