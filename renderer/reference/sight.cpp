#include "renderer/reference/sight.h"

#include "renderer/reference/ray_scene.h"

#include <algorithm>
#include <limits>

namespace obscura {

namespace {

// As smoothNormal() of shaders/gbuffer.frag. All are unit vectors; `view` is towards the eye.
glm::vec3 bentToSeenSide(glm::vec3 normal, const glm::vec3& face, const glm::vec3& view) {
    if (glm::dot(normal, view) >= 0)
        return normal;
    normal -= 2 * std::min(glm::dot(normal, face), 0.0f) * face;
    return glm::normalize(normal - std::min(glm::dot(normal, view), 0.0f) * view);
}

} // namespace

Sight::Sight(const Scene& scene)
    : scene_(scene), bounds_(scene.bounds()),
      rays_(std::make_unique<RayScene>(scene, RayScene::Sides::drawn)),
      materials_(scene.indices.size() / 3) {
    for (const Mesh& mesh : scene.meshes)
        for (std::uint32_t i = 0; i < mesh.indexCount; i += 3)
            materials_[(mesh.firstIndex + i) / 3] = mesh.material;
}

Sight::~Sight() = default;

std::optional<Sight::Seen> Sight::along(const glm::vec3& from, const glm::vec3& direction,
                                        bool withBacks) const {
    RTCRayHit ray{};
    ray.ray.org_x = from.x;
    ray.ray.org_y = from.y;
    ray.ray.org_z = from.z;
    ray.ray.dir_x = direction.x;
    ray.ray.dir_y = direction.y;
    ray.ray.dir_z = direction.z;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0u;
    ray.ray.id = withBacks ? RayScene::meetsBacks : 0;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    findNearest(rays_->handle(), ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    Seen seen;
    seen.distance = ray.ray.tfar;
    seen.firstIndex = rays_->firstIndex(ray.hit);
    const auto corner = [&](std::uint32_t i) -> const Vertex& {
        return scene_.vertices[scene_.indices[seen.firstIndex + i]];
    };
    const glm::vec3 face = glm::normalize(glm::cross(corner(1).position - corner(0).position,
                                                     corner(2).position - corner(0).position));
    const float u = ray.hit.u, v = ray.hit.v;
    const glm::vec3 smooth = glm::normalize(corner(0).normal * (1 - u - v) + corner(1).normal * u +
                                            corner(2).normal * v);
    seen.front = !(glm::dot(face, direction) > 0);
    seen.faceNormal = seen.front ? face : -face;
    seen.normal = bentToSeenSide(seen.front ? smooth : -smooth, seen.faceNormal, -direction);
    return seen;
}

Surfaces Sight::surfaces(const Camera& camera, int width, int height) const {
    Surfaces result;
    result.frame = makeFrame(camera, width, height, bounds_, 1);
    result.width = width;
    result.height = height;
    const glm::mat3 viewFromWorld(result.frame.viewFromWorld),
        worldFromView(result.frame.worldFromView);
    const glm::vec3 eye(result.frame.worldFromView[3]);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3 ahead =
                result.position(static_cast<float>(x), static_cast<float>(y), 1);
            const glm::vec3 direction = worldFromView * glm::normalize(ahead);
            const float slant = glm::length(ahead), near = result.frame.depth.x;
            const auto seen = along(eye + direction * (near * slant), direction);
            result.depth.push_back(seen ? near + seen->distance / slant : result.frame.depth.y);
            result.normal.push_back(seen ? viewFromWorld * seen->normal : glm::vec3(0, 0, 1));
            result.faceNormal.push_back(seen ? viewFromWorld * seen->faceNormal
                                             : glm::vec3(0, 0, 1));
        }
    rays_->throwErrors();
    return result;
}

} // namespace obscura
