#include "renderer/scene/gltf_extensions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace obscura {

using fmt::format;
using nlohmann::json;

namespace {

// The last one describes a file and changes no picture.
constexpr std::array<std::string_view, 11> shown{"EXT_mesh_gpu_instancing",
                                                 "EXT_meshopt_compression",
                                                 "EXT_texture_webp",
                                                 "KHR_draco_mesh_compression",
                                                 "KHR_lights_punctual",
                                                 "KHR_materials_emissive_strength",
                                                 "KHR_materials_pbrSpecularGlossiness",
                                                 "KHR_materials_unlit",
                                                 "KHR_mesh_quantization",
                                                 "KHR_texture_transform",
                                                 "KHR_xmp_json_ld"};

// What the picture lacks where we leave an extension out, and what to do about it.
struct Lack {
    std::string_view name, without, remedy;
};
constexpr std::string_view plainMaterial = "export plain metallic-roughness materials";
constexpr std::array lacks{
    Lack{"EXT_texture_avif", "textures in AVIF cannot be read", "export PNG, JPEG or WebP"},
    Lack{"KHR_animation_pointer", "animations are not played", "export without it"},
    Lack{"KHR_materials_anisotropy", "highlights are round", plainMaterial},
    Lack{"KHR_materials_clearcoat", "clear coats do not shine", plainMaterial},
    Lack{"KHR_materials_dispersion", "glass is drawn opaque", plainMaterial},
    Lack{"KHR_materials_diffuse_transmission", "no light shines through thin materials",
         plainMaterial},
    Lack{"KHR_materials_ior", "every dielectric reflects as with an index of 1.5", plainMaterial},
    Lack{"KHR_materials_iridescence", "thin films have no colours", plainMaterial},
    Lack{"KHR_materials_sheen", "cloth has no sheen", plainMaterial},
    Lack{"KHR_materials_specular", "every dielectric reflects alike", plainMaterial},
    Lack{"KHR_materials_transmission", "glass is drawn opaque", plainMaterial},
    Lack{"KHR_materials_variants", "the default variant is shown", "export one variant"},
    Lack{"KHR_materials_volume", "glass is drawn opaque", plainMaterial},
    Lack{"KHR_meshopt_compression", "its meshes cannot be read",
         "compress with EXT_meshopt_compression, or not at all"},
    Lack{"KHR_node_visibility", "hidden nodes are shown", "delete the hidden nodes"},
    Lack{"KHR_texture_basisu", "textures in KTX2 cannot be read", "export PNG, JPEG or WebP"},
};

const Lack* lackOf(std::string_view name) {
    const auto* found = std::find_if(lacks.begin(), lacks.end(),
                                     [&](const Lack& each) { return each.name == name; });
    return found == lacks.end() ? nullptr : found;
}

bool isShown(std::string_view name) {
    return std::find(shown.begin(), shown.end(), name) != shown.end();
}

void collect(const json& value, std::set<std::string>& names) {
    for (const auto& [key, item] : value.items()) {
        if (value.is_object() && key == "extensions" && item.is_object())
            for (const auto& [name, content] : item.items())
                names.insert(name);
        if (item.is_structured() && key != "extras")
            collect(item, names);
    }
}

void checkNames(const GltfJson& values, const char* key) {
    const json* names = values.find(values.root(), key, "");
    if (!names)
        return;
    if (!names->is_array())
        values.wrong(key, "an array of names", *names);
    for (std::size_t i = 0; i < names->size(); ++i)
        if (!(*names)[i].is_string())
            values.wrong(format("{}[{}]", key, i), "a name", (*names)[i]);
}

} // namespace

void checkGltfExtensions(const GltfJson& values) {
    checkNames(values, "extensionsRequired");
    checkNames(values, "extensionsUsed");
    std::vector<std::string> missing;
    for (const json& each : values.root().value("extensionsRequired", json::array())) {
        const auto name = each.get<std::string>();
        const Lack* lack = lackOf(name);
        if (!isShown(name))
            missing.push_back(
                lack ? format("{} (without it, {}: {})", name, lack->without, lack->remedy)
                     : format("{} (export without it)", name.substr(0, 80)));
    }
    if (!missing.empty())
        values.fail("extensionsRequired",
                    format("expected extensions that are supported, found {} that {} not: {}",
                           missing.size(), missing.size() == 1 ? "is" : "are",
                           fmt::join(missing, "; ")));
}

std::vector<std::string> extensionsLeftOut(const json& root) {
    std::set<std::string> names;
    for (const json& name : root.value("extensionsUsed", json::array()))
        names.insert(name.get<std::string>());
    collect(root, names);
    std::vector<std::string> sentences;
    for (const std::string& name : names) {
        if (isShown(name))
            continue;
        const Lack* lack = lackOf(name);
        sentences.push_back(format("extension {} is not supported; it is left out{}", name,
                                   lack ? format(": {}", lack->without) : ""));
    }
    return sentences;
}

} // namespace obscura
