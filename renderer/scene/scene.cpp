#include "renderer/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace obscura {

Bounds Scene::bounds() const {
    if (vertices.empty())
        return {};
    Bounds result{vertices.front().position, vertices.front().position};
    for (const Vertex& vertex : vertices) {
        result.low = glm::min(result.low, vertex.position);
        result.high = glm::max(result.high, vertex.position);
    }
    return result;
}

bool TextureUse::plain() const { return *this == TextureUse{.texture = texture}; }

// Turned as the example of KHR_texture_transform needs it: with an offset of (0, 1), a scale of a
// half and a quarter turn, it shows the lower left quadrant of the image. (The matrix printed there
// turns the other way, but three.js and the sample model's markers agree with the example.)
glm::mat2 TextureUse::matrix() const {
    const float c = std::cos(rotation), s = std::sin(rotation);
    return glm::mat2(c, -s, s, c) * glm::mat2(scale.x, 0, 0, scale.y);
}

glm::vec2 TextureUse::at(const Vertex& vertex) const {
    return matrix() * (set == 0 ? vertex.uv : vertex.uv1) + offset;
}

bool Material::emits() const { return unlit || emission.r > 0 || emission.g > 0 || emission.b > 0; }

void deriveTangents(Scene& scene, const Mesh& mesh) {
    const auto indices = std::span(scene.indices).subspan(mesh.firstIndex, mesh.indexCount);
    if (indices.empty())
        return;
    const TextureUse use =
        scene.materials.empty()
            ? TextureUse{}
            : scene.materials[static_cast<std::size_t>(mesh.material)].normalTexture;
    const glm::mat2 turn = use.matrix();
    const auto uv = use.set == 0 ? &Vertex::uv : &Vertex::uv1;
    const auto [least, greatest] = std::minmax_element(indices.begin(), indices.end());
    struct Sum {
        glm::vec3 alongU{0}, alongV{0};
        bool used = false;
    };
    std::vector<Sum> sums(*greatest - *least + 1);
    for (std::uint32_t i = 0; i < mesh.indexCount; i += 3) {
        const auto t = indices.subspan(i, 3);
        const Vertex &a = scene.vertices[t[0]], &b = scene.vertices[t[1]],
                     &c = scene.vertices[t[2]];
        const glm::vec3 e = b.position - a.position, f = c.position - a.position;
        const glm::vec2 s = turn * (b.*uv - a.*uv), r = turn * (c.*uv - a.*uv);
        const float area = s.x * r.y - s.y * r.x;
        const glm::vec3 alongU = (e * r.y - f * s.y) / area, alongV = (f * s.x - e * r.x) / area;
        if (!std::isfinite(glm::dot(alongU, alongU) + glm::dot(alongV, alongV)))
            continue; // no area of texture
        for (const std::uint32_t index : t) {
            Sum& sum = sums[index - *least];
            sum.alongU += alongU;
            sum.alongV += alongV;
            sum.used = true;
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const Sum& sum = sums[i];
        if (!sum.used)
            continue;
        Vertex& vertex = scene.vertices[*least + i];
        const glm::vec3 n = vertex.normal;
        glm::vec3 tangent = sum.alongU - n * glm::dot(n, sum.alongU);
        if (glm::length(tangent) < 1e-12f) // no direction of its own: any across the normal
            tangent = glm::cross(n, std::abs(n.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0));
        // A normal map's green points up the image, and glTF's v runs down it.
        const float sign = glm::dot(glm::cross(n, tangent), sum.alongV) > 0 ? -1.0f : 1.0f;
        vertex.tangent = glm::vec4(glm::normalize(tangent), sign);
    }
}

std::size_t dropUnusableTangents(Scene& scene, const Mesh& mesh) {
    if (mesh.indexCount == 0)
        return 0;
    const auto indices = std::span(scene.indices).subspan(mesh.firstIndex, mesh.indexCount);
    const auto [least, greatest] = std::minmax_element(indices.begin(), indices.end());
    std::size_t lost = 0;
    for (Vertex& vertex :
         std::span(scene.vertices).subspan(*least, std::size_t{*greatest} - *least + 1)) {
        const glm::vec3 tangent(vertex.tangent), n = vertex.normal;
        const glm::vec3 across = tangent - n * glm::dot(n, tangent);
        if (glm::dot(across, across) > 1e-8f) // false of NaN
            continue;
        vertex.tangent = glm::vec4(0);
        ++lost;
    }
    return lost;
}

} // namespace obscura
