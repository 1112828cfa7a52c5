// tinygltf's code is compiled here, and no library of it linked: libdraco exports one of its own,
// which takes the place of any that a linker meets later.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include "renderer/scene/gltf_model.h"

#include "renderer/scene/gltf_check.h"

#include <algorithm>

namespace obscura {

tinygltf::Model modelOf(const GltfFile& file) {
    nlohmann::json structure;
    for (const char* key : {"asset", "scene", "scenes", "nodes", "meshes", "materials", "textures",
                            "samplers", "accessors", "bufferViews", "skins"})
        if (file.root().contains(key))
            structure[key] = file.root().at(key);
    // It wants a view of every accessor of indices, where Draco's have none: any will do, till it
    // is through.
    std::vector<std::size_t> viewless;
    if (structure.contains("accessors") && structure.contains("bufferViews"))
        for (nlohmann::json& accessor : structure["accessors"]) {
            if (!accessor.contains("bufferView"))
                viewless.push_back(
                    static_cast<std::size_t>(&accessor - &structure["accessors"][0]));
            accessor.emplace("bufferView", 0);
        }
    const std::string text =
        structure.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string errors, warnings;
    if (!reader.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                    static_cast<unsigned>(text.size()), "")) {
        std::replace(errors.begin(), errors.end(), '\n', ' ');
        failGltf(file.path(), "", "expected a glTF 2.0 scene: " + errors);
    }
    for (const std::size_t i : viewless)
        model.accessors[i].bufferView = -1;
    return model;
}

} // namespace obscura
