#pragma once

#include "gl/draw.h"
#include "renderer/scene/scene.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>
#include <span>

namespace obscura {

// A scene's proxy spheres where shaders can read them: world position, radius (metres).
class ProxySpheres {
  public:
    explicit ProxySpheres(std::span<const glm::vec4> spheres);
    int count() const { return count_; }
    void bind(int binding) const { buffer_.bind(binding); }

  private:
    int count_;
    gl::UniformBuffer buffer_;
};

// Those of a scene, fitted when they are first asked for (renderer/scene/proxies.h).
class SceneSpheres {
  public:
    explicit SceneSpheres(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}
    const ProxySpheres& operator()() const;

  private:
    std::shared_ptr<const Scene> scene_;
    mutable std::optional<ProxySpheres> spheres_;
};

} // namespace obscura
