#pragma once

#include "renderer/frame/surfaces.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace obscura {

class RayScene;

// What can be seen of a scene from a place, by rays: for whoever looks around in it many times, or
// where there is no OpenGL. Rays meet what a picture shows: no backs of materials that are not
// double-sided, and no holes of masked ones. Any thread may look.
class Sight {
  public:
    // The scene must outlive it.
    explicit Sight(const Scene& scene);
    ~Sight();

    const Scene& scene() const { return scene_; }
    const Bounds& bounds() const { return bounds_; }

    struct Seen {
        float distance = 0;           // metres
        std::uint32_t firstIndex = 0; // where its triangle begins in Scene::indices
        bool front = true;            // the side on which its corners run against the clock
        glm::vec3 normal{0};          // between vertices, and the triangle's own; world space, unit
        glm::vec3 faceNormal{0};      // (the first as far as the file's are), towards the eye
    };
    // Nearest along a unit direction. `withBacks`: sides that pictures leave out are met as well.
    std::optional<Seen> along(const glm::vec3& from, const glm::vec3& direction,
                              bool withBacks = false) const;
    // As surfacesOf() with smooth normals, each pixel by one ray through its centre. Rounding
    // makes few pixels differ: those at the edges of triangles.
    Surfaces surfaces(const Camera& camera, int width, int height) const;

    // The index of its material in Scene::materials.
    int materialAt(std::uint32_t firstIndex) const { return materials_[firstIndex / 3]; }

  private:
    const Scene& scene_;
    Bounds bounds_;
    std::unique_ptr<RayScene> rays_;
    std::vector<int> materials_; // by triangle
};

} // namespace obscura
