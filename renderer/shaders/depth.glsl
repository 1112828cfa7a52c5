// Reading the depth buffer: nearest pixel, clamped at the screen's border.

#include "view.glsl"

// The pixel, or the nearest one of the border.
ivec2 insideOf(ivec2 pixel) { return clamp(pixel, ivec2(0), ivec2(frame.size.xy) - 1); }

// The depth of a pixel that is known to be inside the image.
float depthInside(ivec2 pixel) { return texelFetch(depthBuffer, pixel, 0).r; }

float depthOf(ivec2 pixel) { return depthInside(insideOf(pixel)); }

float depthAt(vec2 uv) { return depthInside(pixelOf(uv)); }

// The surface in view space over a screen position, in the middle of its pixel; beyond the border,
// as deep as at it.
vec3 surfaceOver(vec2 uv) {
    vec2 pixel = clamp(floor(uv * frame.size.xy), vec2(-1e6), vec2(1e6));
    return viewPosition((pixel + 0.5) * frame.size.zw, depthOf(ivec2(pixel)));
}
