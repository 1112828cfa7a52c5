// Horizon-based ambient occlusion, Bavoil, Sainz and Dimitrov 2008: horizon.glsl over the full
// image and a cross-bilateral blur. Puri 2024 (Leeds), sections 2.4 and 3.4, describes the same
// with 4 directions of 4 steps, without W, and halved; here W is a parameter and halving is
// `intensity`.
//
// ownLayer makes its taps keep to the lattice of hbao_deinterleaved, so that the two can be
// compared tap for tap, and what deinterleaving costs in near detail can be seen.
//
// Limit: horizon.glsl's. For a curb at distance d with a step h, seen from above, with radius R:
// 1 / 2 pi integral over |phi| < pi / 2 of W h / sqrt(h^2 + (d / cos phi)^2), as far as the rim is
// within R; nothing where it is not.

#include "blur_gaussian.glsl"
#include "horizon.glsl"
#include "taps_full.glsl"

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    int stride = settings.ownLayer > 0.5 ? 4 : 1;
    return vec4(1.0 - horizonOcclusion(pixel, pixel, depth, settings.radius, stride));
}

vec4 blurAcross(ivec2 pixel) { return blurAlong(gatherResult, pixel, ivec2(1, 0), 1); }
vec4 blurDown(ivec2 pixel) { return blurAlong(blurAcrossResult, pixel, ivec2(0, 1), 1); }
