#include "renderer/techniques/proxy_spheres.h"

#include "renderer/scene/proxies.h"

namespace obscura {

namespace {

constexpr glm::vec4 noSphere[] = {glm::vec4(0)}; // because a buffer must not be empty

} // namespace

ProxySpheres::ProxySpheres(std::span<const glm::vec4> spheres)
    : count_(static_cast<int>(spheres.size())),
      buffer_(std::as_bytes(spheres.empty() ? noSphere : spheres),
              gl::UniformBuffer::Kind::storage) {}

const ProxySpheres& SceneSpheres::operator()() const {
    if (!spheres_)
        spheres_.emplace(proxySpheres(*scene_));
    return *spheres_;
}

} // namespace obscura
