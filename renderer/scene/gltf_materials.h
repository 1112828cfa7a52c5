#pragma once

#include "renderer/scene/gltf_file.h"
#include "renderer/scene/scene.h"

#include <tiny_gltf.h>

#include <array>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace obscura {

// Materials and textures of a checked glTF file, as far as we show them, with the extensions
// KHR_texture_transform, KHR_materials_emissive_strength, KHR_materials_unlit,
// KHR_materials_pbrSpecularGlossiness and EXT_texture_webp. A material reads at most two sets of
// texture coordinates; textures of it that want a third are left out with a warning.
class GltfMaterials {
  public:
    using Warn = std::function<void(const std::string&)>;
    // Which TEXCOORD_n are read into Vertex::uv and into Vertex::uv1; -1: none.
    using Coordinates = std::array<int, 2>;

    GltfMaterials(const GltfFile& file, const tinygltf::Model& model, Warn warn);

    // All of the file, in its order.
    std::vector<Material> materials();
    // By a material's index in the file.
    Coordinates coordinates(int material) const {
        return coordinates_[static_cast<std::size_t>(material)];
    }
    // What the materials read, decoded on all cores.
    std::vector<Texture> textures() const;

  private:
    using Key = std::tuple<int, int, bool>; // image, sampler, colour

    Material convert(const nlohmann::json& from);
    void readReflectance(const nlohmann::json& from, Material& to);
    void readEmission(const nlohmann::json& from, Material& to);
    void warnOfAbsent(const nlohmann::json& from, const Material& to) const;
    TextureUse use(const nlohmann::json& parent, const char* key, bool colour,
                   const Material& material);
    int textureOf(int index, bool colour);
    Texture decode(const Key& key) const;

    const GltfFile& file_;
    const tinygltf::Model& model_;
    Warn warn_;
    std::vector<Coordinates> coordinates_;
    std::map<Key, int> known_; // to the index in textures()
};

} // namespace obscura
