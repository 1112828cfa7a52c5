// Reading the depth buffer: nearest pixel, clamped at the screen's border.

#include "view.glsl"

float depthOf(ivec2 pixel) {
    return texelFetch(depthBuffer, clamp(pixel, ivec2(0), ivec2(frame.size.xy) - 1), 0).r;
}

float depthAt(vec2 uv) { return depthOf(pixelOf(uv)); }
