#pragma once

#include "renderer/frame/gbuffer.h"

#include <vector>

namespace obscura {

// What a camera sees, on the CPU: the very points that techniques work from, for the references to
// trace from. View space (shaders/view.glsl); rows from bottom to top, as OpenGL has them.
struct Surfaces {
    Frame frame{};
    int width = 0, height = 0;
    std::vector<float> depth;          // linear view depth, metres; frame.depth.y where empty
    std::vector<glm::vec3> normal;     // unit, of the kind that was asked for
    std::vector<glm::vec3> faceNormal; // unit, the triangle's own, towards the camera

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
    bool empty(std::size_t i) const { return depth[i] >= frame.depth.y; }
    // The point that pixel (x, y) shows; x and y may be fractions, whole numbers are centres.
    glm::vec3 position(float x, float y, float viewDepth) const;
};

// Draws the frame, which must be bound, and reads it back.
Surfaces surfacesOf(const GpuScene& scene, const GBufferPass& pass, const Frame& frame,
                    Normals kind);

} // namespace obscura
