#include "renderer/scene/ground.h"

#include "base/error.h"
#include "base/files.h"
#include "renderer/scene/quads.h"

#include <fmt/format.h>

#include <algorithm>

namespace obscura {

void addGround(Scene& scene, const Ground& ground) {
    const Bounds bounds = scene.bounds();
    const auto wall = static_cast<float>(ground.wall);
    if (wall > bounds.low.z)
        throw Error(fmt::format("ground.wall: expected a wall behind the scene, which begins at z "
                                "= {:g}, found z = {:g}",
                                bounds.low.z, wall));
    const glm::vec3 size = bounds.high - bounds.low, middle = (bounds.low + bounds.high) / 2.0f;
    const float reach = 2 * std::max({size.x, size.y, size.z});
    const float left = middle.x - reach, right = middle.x + reach, floor = bounds.low.y,
                front = bounds.high.z + reach, top = floor + reach;
    Scene plain; // of one material
    addQuad(plain, {glm::vec3(left, floor, front),
                    {right, floor, front},
                    {right, floor, wall},
                    {left, floor, wall}});
    addQuad(plain, {glm::vec3(left, floor, wall),
                    {right, floor, wall},
                    {right, top, wall},
                    {left, top, wall}});
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    scene.meshes.push_back({static_cast<std::uint32_t>(scene.indices.size()),
                            static_cast<std::uint32_t>(plain.indices.size()),
                            static_cast<int>(scene.materials.size())});
    scene.vertices.insert(scene.vertices.end(), plain.vertices.begin(), plain.vertices.end());
    for (const std::uint32_t index : plain.indices)
        scene.indices.push_back(first + index);
    Material material;
    material.name = "ground";
    material.baseColour = {ground.colour[0], ground.colour[1], ground.colour[2], 1};
    scene.materials.push_back(material);
    scene.sha256 = sha256With(ground, scene.sha256);
}

// 1: a change of what a ground looks like needs another number.
std::string sha256With(const Ground& ground, const std::string& sceneSha256) {
    return sha256(fmt::format("{} ground 1 {:a} {:a} {:a} {:a}", sceneSha256, ground.wall,
                              ground.colour[0], ground.colour[1], ground.colour[2]));
}

} // namespace obscura
