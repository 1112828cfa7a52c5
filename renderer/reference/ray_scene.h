#pragma once

#include "renderer/reference/embree.h"
#include "renderer/scene/scene.h"

#include <memory>

namespace obscura {

// A scene's triangles where Embree can find them: robust intersection, static high-quality build.
// Both sides of a triangle are met. Masked materials have the rasteriser's holes: alpha of level 0
// of the base colour map, filtered and wrapped as OpenGL does it, times the base colour's and the
// vertices', below the cutoff. (The rasteriser's distant pixels read coarser levels; rays have no
// distance.)
class RayScene {
  public:
    // Copies positions, indices, and of masked materials texture coordinates, vertex alpha and
    // 8-bit alpha of the map.
    explicit RayScene(const Scene& scene);
    ~RayScene();
    RayScene(RayScene&&) noexcept;

    RTCScene handle() const;
    // Throws an Error if Embree has complained of anything.
    void throwErrors() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace obscura
