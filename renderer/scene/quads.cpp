#include "renderer/scene/quads.h"

namespace obscura {

void addQuad(Scene& scene, const std::array<glm::vec3, 4>& corners) {
    if (scene.materials.empty()) {
        scene.materials.push_back({});
        scene.meshes.push_back({});
    }
    const glm::vec3 normal =
        glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const glm::vec3& corner : corners)
        scene.vertices.push_back({corner, normal, {}, {}});
    for (const std::uint32_t i : {0, 1, 2, 0, 2, 3})
        scene.indices.push_back(first + i);
    scene.meshes[0].indexCount = static_cast<std::uint32_t>(scene.indices.size());
}

void addBox(Scene& scene, glm::vec3 low, glm::vec3 high) {
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        for (const bool top : {false, true}) {
            // Around the face's outward normal: next, then last, for the higher one of the two.
            glm::vec3 across(0), up(0), origin = low;
            origin[axis] = top ? high[axis] : low[axis];
            across[top ? next : last] = top ? high[next] - low[next] : high[last] - low[last];
            up[top ? last : next] = top ? high[last] - low[last] : high[next] - low[next];
            addQuad(scene, {origin, origin + across, origin + across + up, origin + up});
        }
    }
}

} // namespace obscura
