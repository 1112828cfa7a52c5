#pragma once

#include "renderer/frame/triangle_buffers.h"
#include "renderer/scene/scene.h"

#include <memory>
#include <optional>

namespace obscura {

// The tree of a scene's triangles, built by Embree with its surface-area heuristic on all cores;
// leaves have up to four.
TriangleTree triangleTree(const Scene& scene);

// A scene's triangles as techniques ask for them (Reads::triangles,
// renderer/techniques/technique.h): built and uploaded when they are first asked for.
class SceneTriangles {
  public:
    explicit SceneTriangles(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}
    const TriangleBuffers& operator()() const;

  private:
    std::shared_ptr<const Scene> scene_;
    mutable std::optional<TriangleBuffers> buffers_;
};

} // namespace obscura
