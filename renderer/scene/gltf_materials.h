#pragma once

#include "renderer/scene/gltf_file.h"
#include "renderer/scene/scene.h"

#include <tiny_gltf.h>

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace obscura {

// Materials and textures of a checked glTF file, as far as we show them. A material reads one set
// of texture coordinates, that of its base colour (or else of its first texture); textures of it
// that want another are left out with a warning.
class GltfMaterials {
  public:
    using Warn = std::function<void(const std::string&)>;

    GltfMaterials(const GltfFile& file, const tinygltf::Model& model, Warn warn);

    // All of the file, in its order.
    std::vector<Material> materials();
    // The set of texture coordinates that a material reads, by its index in the file.
    int coordinates(int material) const { return coordinates_[static_cast<std::size_t>(material)]; }
    // What the materials read, decoded on all cores.
    std::vector<Texture> textures() const;

  private:
    using Key = std::tuple<int, int, bool>; // image, sampler, colour

    Material convert(const tinygltf::Material& from, const std::string& at);
    int textureOf(int index, int coordinates, bool colour, const std::string& material,
                  const std::string& at);
    Texture decode(const Key& key) const;

    const GltfFile& file_;
    const tinygltf::Model& model_;
    Warn warn_;
    std::vector<int> coordinates_;
    std::map<Key, int> known_; // to the index in textures()
};

} // namespace obscura
