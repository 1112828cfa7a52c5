// Depth in levels of half the size each, averaged over what lies no more than about a radius in
// front of the farthest of four (XeGTAO's weights, from 0.75 of the radius down to where falloff
// begins by default), so that a thin thing in front does not drag the wall behind it forward.
//
// Departure: XeGTAO averages depth, we its inverse. That is linear on the screen over a plane, so a
// plane stays itself on every level and does not occlude itself.

#include "depth.glsl"

vec4 depths(ivec2 pixel) { return vec4(depthOf(pixel)); }

vec4 depthsLevel(ivec2 pixel) {
    ivec2 last = textureSize(depthsResult, 0) - 1;
    vec4 four;
    for (int i = 0; i < 4; ++i)
        four[i] = texelFetch(depthsResult, min(2 * pixel + ivec2(i & 1, i >> 1), last), 0).r;
    float farthest = max(max(four.x, four.y), max(four.z, four.w));
    float reach = 0.75 * settings.radius;
    vec4 weights = clamp((reach - (farthest - four)) / (0.615 * reach), 0.0, 1.0);
    return vec4(dot(weights, vec4(1.0)) / dot(weights, 1.0 / four));
}

// A level whose texels are longer than the image has no middle inside it.
int coarsestLevel() {
    return min(textureQueryLevels(depthsResult) - 1,
               findMSB(min(int(frame.size.x), int(frame.size.y))));
}

// The whole part of the binary logarithm, which is a float's exponent.
int levelOf(float scale, int coarsest) {
    return clamp((floatBitsToInt(scale) >> 23) - 127, 0, coarsest);
}

// Depth of the level's texel around a pixel, and the uv it stands for: the texel's middle, so that
// what is read and where it is agree.
float depthOfTap(ivec2 pixel, int level, out vec2 uv) {
    // Not textureSize(): llvmpipe gives all pixels of a group the size of the first one's level.
    ivec2 texel = min(pixel >> level, max(ivec2(frame.size.xy) >> level, ivec2(1)) - 1);
    uv = (vec2(texel) + 0.5) * float(1 << level) * frame.size.zw;
    return texelFetch(depthsResult, texel, level).r;
}
