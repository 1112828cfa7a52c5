#pragma once

#include "image/image.h"
#include "protocols/reader/study.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace obscura {

// A static scene as the renderer and the ray tracer need it: triangles in world space (metres,
// y up), with node transforms already applied. Nothing unused is kept.

struct Vertex {
    glm::vec3 position{0};
    glm::vec3 normal{0};
    glm::vec4 tangent{0}; // w: sign of the bitangent; all zero where no normal map applies
    glm::vec2 uv{0};
    glm::vec2 uv1{0};    // the second set, where a material reads it
    glm::vec4 colour{1}; // linear; multiplied with the material's base colour
};

// What a texture shows beyond its borders.
enum class Wrap { repeat, mirrored, clamp };

// How a texture is made smaller: OpenGL's six ways, in the order of their numbers. The first two
// have no mipmaps.
enum class Minified {
    nearest,
    linear,
    nearestMipmapNearest,
    linearMipmapNearest,
    nearestMipmapLinear,
    linearMipmapLinear
};

struct Texture {
    Image8 image;      // 4 channels, 8 bits
    bool srgb = false; // colour, not data
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
    bool nearest = false; // enlarged, its texels are squares
    Minified minified = Minified::linearMipmapLinear;
};

// A texture as a material reads it: where on it a vertex is (KHR_texture_transform).
struct TextureUse {
    int texture = -1; // into Scene::textures; -1: none
    int set = 0;      // of coordinates: 0 reads Vertex::uv, 1 Vertex::uv1
    glm::vec2 offset{0}, scale{1};
    float rotation = 0; // radians, counter-clockwise for eyes that see v run down

    bool exists() const { return texture >= 0; }
    // Reads Vertex::uv as it is.
    bool plain() const;
    // Coordinates are matrix() * set + offset: scaled, then turned, then moved.
    glm::mat2 matrix() const;
    glm::vec2 at(const Vertex& vertex) const;

    bool operator==(const TextureUse&) const = default;
};

// KHR_materials_pbrSpecularGlossiness, linear.
struct SpecularGlossiness {
    glm::vec3 specular{1}; // reflectance face-on
    float glossiness = 1;  // 1 - roughness
};

// glTF 2.0 metallic-roughness, as far as it is used.
struct Material {
    std::string name;
    glm::vec4 baseColour{1}; // linear, multiplied with the texture
    TextureUse baseColourTexture = {};
    TextureUse normalTexture = {};
    float normalScale = 1;
    TextureUse metallicRoughnessTexture = {}; // roughness in green, metallic in blue
    float metallic = 0;
    float roughness = 1;
    float alphaCutoff = 0; // > 0: where there is less alpha are holes
    bool doubleSided = false;
    glm::vec3 emission{0}; // linear radiance, multiplied with the texture
    TextureUse emissionTexture = {};
    bool unlit = false; // shows its base colour, whatever the light
    // In place of metallic and roughness. The base colour is the diffuse one then, and the texture
    // of metallic and roughness has the specular colour (as sRGB), glossiness in alpha.
    std::optional<SpecularGlossiness> specularGlossiness = {};

    bool emits() const; // light of its own, or is unlit
};

// A run of triangles of one material: three indices each.
struct Mesh {
    std::uint32_t firstIndex = 0, indexCount = 0;
    int material = 0;
};

// A camera that the file brings. Its target is one metre ahead.
struct NamedCamera {
    std::string name;
    Camera camera;
};

// A light that the file brings (KHR_lights_punctual), in world space.
struct PointLight {
    enum class Kind { directional, point, spot };
    Kind kind = Kind::point;
    glm::vec3 position{0};
    glm::vec3 direction{0, 0, -1}; // unit, the way the light goes
    glm::vec3 intensity{1};        // linear: lux of a directional light, candela of the others
    float range = 0;               // metres beyond which it is dark; 0: none
    float innerCosine = 1;         // of a spot: full within this angle from its direction,
    float outerCosine = 0;         // dark beyond this one
};

struct Bounds {
    glm::vec3 low{0}, high{0};
};

struct Scene {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<NamedCamera> cameras;  // perspective ones, in the order of the scene's nodes
    std::vector<PointLight> lights;    // in the order of the scene's nodes
    std::string sha256;                // of every file read; when built in, of all it consists of
    std::vector<std::string> warnings; // what the file uses and we do not show

    Bounds bounds() const; // of the positions; of the origin for an empty scene
};

// glTF 2.0 (.gltf or .glb). Node transforms are applied; missing normals become flat, missing
// tangents are derived where a normal map needs them. What the file requires and we cannot show is
// an Error; what it merely uses is a warning.
Scene loadScene(const std::filesystem::path& path);

// SHA-256 of the file and all files it refers to, as Scene::sha256, without decoding any.
std::string sceneSha256(const std::filesystem::path& path);

// Derives per-vertex tangents from positions, normals and the texture coordinates that the mesh's
// normal map is read with (Lengyel 2001).
// Indices are into `scene.vertices`, three a triangle.
// Vertices without a usable direction get none: zero.
void deriveTangents(Scene& scene, const Mesh& mesh);

// Sets tangents to zero that are no direction or point along the normal; shaders take zero for "no
// normal map here". Returns how many of the mesh's vertices have no tangent.
std::size_t dropUnusableTangents(Scene& scene, const Mesh& mesh);

} // namespace obscura
