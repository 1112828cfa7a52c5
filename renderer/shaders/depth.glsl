// Reading the depth buffer: nearest pixel, clamped at the screen's border.

#include "view.glsl"

float depthOf(ivec2 pixel) {
    return texelFetch(depthBuffer, clamp(pixel, ivec2(0), ivec2(frame.size.xy) - 1), 0).r;
}

float depthAt(vec2 uv) { return depthOf(pixelOf(uv)); }

// The surface in view space over a screen position, in the middle of its pixel; beyond the border,
// as deep as at it.
vec3 surfaceOver(vec2 uv) {
    vec2 pixel = clamp(floor(uv * frame.size.xy), vec2(-1e6), vec2(1e6));
    return viewPosition((pixel + 0.5) * frame.size.zw, depthOf(ivec2(pixel)));
}
