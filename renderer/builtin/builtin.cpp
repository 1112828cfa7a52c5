#include "renderer/builtin/builtin.h"

#include "base/error.h"
#include "base/files.h"
#include "renderer/builtin/scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace obscura {

namespace {

const std::array<std::string, 5> names{"sculpture", "atrium", "figures", "room", "garden"};

template <typename T>
void addBytes(Sha256& hash, const std::vector<T>& values) {
    hash.add(fmt::format("{} of {} bytes\n", values.size(), sizeof(T)));
    hash.add(std::as_bytes(std::span(values)));
}

// The structures are taken apart by as many names as they have members, so that a new member does
// not compile until it is hashed here, too. Of what few scenes have, nothing is hashed where it is
// as it is without: their hashes stay.

void addMesh(Sha256& hash, const Mesh& mesh) {
    const auto& [firstIndex, indexCount, material] = mesh;
    hash.add(fmt::format("mesh {} {} {}\n", firstIndex, indexCount, material));
}

void addUse(Sha256& hash, const TextureUse& from) {
    const auto& [texture, set, offset, scale, rotation] = from;
    if (!from.plain())
        hash.add(fmt::format("use {} {} {:a} {:a} {:a} {:a} {:a}\n", texture, set, offset.x,
                             offset.y, scale.x, scale.y, rotation));
}

void addMaterial(Sha256& hash, const Material& from) {
    const auto& [name, baseColour, baseColourTexture, normalTexture, normalScale,
                 metallicRoughnessTexture, metallic, roughness, alphaCutoff, doubleSided, emission,
                 emissionTexture, unlit, specularGlossiness] = from;
    hash.add(fmt::format("material {:a} {:a} {:a} {:a} {} {} {:a} {} {:a} {:a} {:a} {}\n",
                         baseColour.r, baseColour.g, baseColour.b, baseColour.a,
                         baseColourTexture.texture, normalTexture.texture, normalScale,
                         metallicRoughnessTexture.texture, metallic, roughness, alphaCutoff,
                         doubleSided));
    for (const TextureUse& use :
         {baseColourTexture, normalTexture, metallicRoughnessTexture, emissionTexture})
        addUse(hash, use);
    if (from.emits())
        hash.add(fmt::format("emits {:a} {:a} {:a} {} {}\n", emission.r, emission.g, emission.b,
                             emissionTexture.texture, unlit));
    if (specularGlossiness)
        hash.add(fmt::format("specular {:a} {:a} {:a} {:a}\n", specularGlossiness->specular.r,
                             specularGlossiness->specular.g, specularGlossiness->specular.b,
                             specularGlossiness->glossiness));
}

void addTexture(Sha256& hash, const Texture& texture) {
    const auto& [image, srgb, wrapU, wrapV, nearest, minified] = texture;
    const auto& [width, height, channels, pixels] = image;
    hash.add(fmt::format("texture {} x {} x {} {} {} {} {}\n", width, height, channels, srgb,
                         static_cast<int>(wrapU), static_cast<int>(wrapV), nearest));
    if (minified != Texture{}.minified)
        hash.add(fmt::format("minified {}\n", static_cast<int>(minified)));
    addBytes(hash, pixels);
}

void addVertices(Sha256& hash, const std::vector<Vertex>& vertices) {
    using Plain = std::array<float, 12>; // position, normal, tangent, uv
    using Rest = std::array<float, 6>;   // uv1, colour
    static_assert(sizeof(Vertex) == sizeof(Plain) + sizeof(Rest), "vertices are hashed whole");
    std::vector<Plain> plain(vertices.size());
    std::vector<Rest> rest(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const auto* floats = reinterpret_cast<const float*>(&vertices[i]);
        std::copy_n(floats, plain[i].size(), plain[i].begin());
        std::copy_n(floats + plain[i].size(), rest[i].size(), rest[i].begin());
    }
    addBytes(hash, plain);
    if (std::any_of(rest.begin(), rest.end(),
                    [](const Rest& each) { return each != Rest{0, 0, 1, 1, 1, 1}; }))
        addBytes(hash, rest);
}

void addLight(Sha256& hash, const PointLight& light) {
    const auto& [kind, position, direction, intensity, range, innerCosine, outerCosine] = light;
    hash.add(fmt::format("light {}", static_cast<int>(kind)));
    for (const glm::vec3& v : {position, direction, intensity})
        hash.add(fmt::format(" {:a} {:a} {:a}", v.x, v.y, v.z));
    hash.add(fmt::format(" {:a} {:a} {:a}\n", range, innerCosine, outerCosine));
}

} // namespace

std::string contentSha256(const Scene& scene) {
    const auto& [vertices, indices, meshes, materials, textures, cameras, lights, sha256,
                 warnings] = scene;
    Sha256 hash;
    addVertices(hash, vertices);
    addBytes(hash, indices);
    for (const Mesh& mesh : meshes)
        addMesh(hash, mesh);
    for (const Material& material : materials)
        addMaterial(hash, material);
    for (const Texture& texture : textures)
        addTexture(hash, texture);
    for (const PointLight& light : lights)
        addLight(hash, light);
    return hash.hex();
}

std::span<const std::string> builtinSceneNames() { return names; }

Scene builtinScene(std::string_view name) {
    constexpr std::array makers{&builtin::sculpture, &builtin::atrium, &builtin::figures,
                                &builtin::room, &builtin::garden};
    static_assert(makers.size() == std::tuple_size_v<std::remove_const_t<decltype(names)>>);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw Error(fmt::format("no built-in scene \"{}\"{}", name, suggestion(name, names)));
    Scene scene = makers[static_cast<std::size_t>(found - names.begin())]();
    scene.sha256 = contentSha256(scene);
    return scene;
}

} // namespace obscura
