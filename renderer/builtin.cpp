#include "renderer/builtin.h"

#include "protocols/error.h"
#include "protocols/files.h"
#include "renderer/builtin_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace obscura {

namespace {

const std::array<std::string, 3> names{"sculpture", "atrium", "figures"};

template <typename T>
void addBytes(Sha256& hash, const std::vector<T>& values) {
    hash.add(std::as_bytes(std::span(values)));
}

std::string contentSha256(std::string_view name, const Scene& scene) {
    Sha256 hash;
    hash.add(name);
    addBytes(hash, scene.vertices);
    addBytes(hash, scene.indices);
    for (const Texture& texture : scene.textures)
        addBytes(hash, texture.image.pixels);
    return hash.hex();
}

} // namespace

std::span<const std::string> builtinSceneNames() { return names; }

Scene builtinScene(std::string_view name) {
    constexpr std::array<Scene (*)(), 3> makers{builtin::sculpture, builtin::atrium,
                                                builtin::figures};
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw Error(fmt::format("no built-in scene \"{}\"{}", name, suggestion(name, names)));
    Scene scene = makers[static_cast<std::size_t>(found - names.begin())]();
    scene.sha256 = contentSha256(name, scene);
    return scene;
}

} // namespace obscura
