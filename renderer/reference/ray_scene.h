#pragma once

#include "renderer/reference/embree.h"
#include "renderer/scene/scene.h"

#include <memory>

namespace obscura {

// A scene's triangles where Embree can find them: static, and of high quality where both sides are
// met, as references want it. Intersection is `robust`, or up to a sixth faster and a ray may slip
// through an edge.
// Masked materials have the rasteriser's holes: alpha of level 0
// of the base colour map, filtered and wrapped as OpenGL does it, times the base colour's and the
// vertices', below the cutoff. (The rasteriser's distant pixels read coarser levels; rays have no
// distance.)
class RayScene {
  public:
    // Which sides of triangles are met: both, or those that the rasteriser draws, which skips the
    // backs of materials that are not double-sided. In a scene of the latter kind a ray with the id
    // `meetsBacks` meets both all the same.
    enum class Sides { both, drawn };
    static constexpr unsigned meetsBacks = 1;

    // Copies positions, indices, and of masked materials texture coordinates, vertex alpha and
    // 8-bit alpha of the map.
    explicit RayScene(const Scene& scene, Sides sides = Sides::both, bool robust = true);
    ~RayScene();
    RayScene(RayScene&&) noexcept;

    RTCScene handle() const;
    // Where in Scene::indices the triangle that was hit begins; of a scene of drawn sides.
    std::uint32_t firstIndex(const RTCHit& hit) const;
    // Throws an Error if Embree has complained of anything.
    void throwErrors() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace obscura
