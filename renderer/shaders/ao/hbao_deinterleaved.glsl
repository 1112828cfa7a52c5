// HBAO over sixteen deinterleaved layers (taps_layered.glsl has the sources). The estimator is
// hbao's own; what differs is the lattice of the taps: steps are multiples of four pixels, so
// occluders nearer than that are seen only by the pixels whose lattice meets them, and what is left
// of them in the picture is the blur's. With `ownLayer` set, hbao takes the same taps and gives the
// same values; without it the two agree in the mean wherever geometry is coarser than four pixels.
//
// Limit: hbao's, as pixels become small against the radius.

#include "blur_gaussian.glsl"
#include "horizon.glsl"
#include "taps_layered.glsl"

vec4 shade(ivec2 pixel, int layer) {
    ivec2 place = placeOf(layer);
    ivec2 full = 4 * pixel + place;
    float depth = tapDepth(pixel, place, 4);
    if (isEmpty(depth))
        return vec4(1.0);
    return vec4(1.0 - horizonOcclusion(full, full, depth, settings.radius, 4));
}

vec4 blurAcross(ivec2 pixel) { return blurAlong(mergeResult, pixel, ivec2(1, 0), 1); }
vec4 blurDown(ivec2 pixel) { return blurAlong(blurAcrossResult, pixel, ivec2(0, 1), 1); }
