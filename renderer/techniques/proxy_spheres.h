#pragma once

#include "gl/draw.h"
#include "renderer/scene/scene.h"

#include <glm/glm.hpp>

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

// Those of a scene, fitted when they are first asked for (renderer/scene/proxies.h). Of the scene
// it keeps the triangles alone.
class SceneSpheres {
  public:
    explicit SceneSpheres(const Scene& scene) {
        triangles_.vertices = scene.vertices;
        triangles_.indices = scene.indices;
    }
    const ProxySpheres& operator()() const;

  private:
    Scene triangles_;
    mutable std::optional<ProxySpheres> spheres_;
};

} // namespace obscura
