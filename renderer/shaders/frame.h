// The camera block, read by C++ and by GLSL. Only mat4, vec4 and ivec4: there C++ and std140 agree
// by construction.
#ifdef __cplusplus
#pragma once

#include <glm/glm.hpp>

namespace obscura {
using glm::ivec4;
using glm::mat4;
using glm::vec4;
#endif

struct Frame {
    mat4 viewFromWorld;
    mat4 worldFromView;
    mat4 clipFromView; // reversed depth, infinitely far; with this frame's sub-pixel jitter
    vec4 viewFromUv;   // view.xy = (uv * .xy + .zw) * depth
    vec4 size;         // .xy pixels, .zw their inverse
    vec4 depth;        // .x nearest, .y value of empty pixels, .z focus distance (metres),
                       // .w uv in height that one metre covers at depth 1
    vec4 depthStep;    // from a stored depth to the next: .x depth + .y depth^2 (metres)
    ivec4 seed;        // .x of the noise; .y accumulated frames so far, by which it differs too
};

#ifdef __cplusplus
static_assert(sizeof(Frame) == 3 * 64 + 5 * 16);
} // namespace obscura
#endif
