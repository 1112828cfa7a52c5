#include "renderer/scene/occluders.h"

#include <algorithm>
#include <cmath>

namespace obscura {

namespace {

int texelOf(float place, int size, Wrap wrap) {
    const float whole = std::floor(place);
    float inside = place - whole;
    if (wrap == Wrap::clamp)
        inside = std::clamp(place, 0.0f, 1.0f);
    else if (wrap == Wrap::mirrored && std::fmod(whole, 2.0f) != 0)
        inside = 1 - inside;
    return std::min(static_cast<int>(inside * static_cast<float>(size)), size - 1);
}

// Of the map alone; 1 without one.
float alphaAt(const Texture& texture, glm::vec2 uv) {
    const Image8& image = texture.image;
    const auto x = static_cast<std::size_t>(texelOf(uv.x, image.width, texture.wrapU));
    const auto y = static_cast<std::size_t>(texelOf(uv.y, image.height, texture.wrapV));
    return static_cast<float>(
               image.pixels[4 * (y * static_cast<std::size_t>(image.width) + x) + 3]) /
           255;
}

float coverageOf(const Scene& scene, const Material& material, const Vertex* const (&corners)[3]) {
    if (material.alphaCutoff <= 0)
        return 1;
    const TextureUse& use = material.baseColourTexture;
    glm::vec2 places[3];
    for (int i = 0; i < 3; ++i)
        places[i] = use.at(*corners[i]);
    constexpr int side = 8; // its squares, halved along the diagonal, fill the triangle evenly
    int covered = 0;
    for (int i = 0; i < side * side; ++i) {
        const int row = static_cast<int>(std::sqrt(static_cast<float>(i)));
        const int along = i - row * row; // 0 ... 2 row
        const float u = (static_cast<float>(row) + 0.5f) / side;
        const float v = u * (static_cast<float>(along) + 0.5f) / static_cast<float>(2 * row + 1);
        const float weights[3] = {1 - u, u - v, v};
        float alpha = 0;
        glm::vec2 place(0);
        for (int k = 0; k < 3; ++k) {
            alpha += weights[k] * corners[k]->colour.a;
            place += weights[k] * places[k];
        }
        alpha *= material.baseColour.a;
        if (use.exists())
            alpha *= alphaAt(scene.textures[static_cast<std::size_t>(use.texture)], place);
        covered += alpha >= material.alphaCutoff ? 1 : 0;
    }
    return static_cast<float>(covered) / (side * side);
}

} // namespace

std::vector<Occluder> occluders(const Scene& scene) {
    std::vector<Occluder> result;
    for (const Mesh& mesh : scene.meshes) {
        const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
        for (std::uint32_t i = mesh.firstIndex; i + 2 < mesh.firstIndex + mesh.indexCount; i += 3) {
            const Vertex* const corners[3] = {&scene.vertices[scene.indices[i]],
                                              &scene.vertices[scene.indices[i + 1]],
                                              &scene.vertices[scene.indices[i + 2]]};
            const glm::vec3 a = corners[0]->position, b = corners[1]->position,
                            c = corners[2]->position;
            if (glm::length(glm::cross(b - a, c - a)) > 0)
                result.push_back({glm::vec4(a, coverageOf(scene, material, corners)),
                                  glm::vec4(b, material.doubleSided ? 1 : 0), glm::vec4(c, 0)});
        }
    }
    return result;
}

} // namespace obscura
