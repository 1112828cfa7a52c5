// HBAO at two scales and two resolutions, after Bavoil and Sainz 2009 ("Multi-layer dual-resolution
// screen-space ambient occlusion", SIGGRAPH talk; one depth layer only): the whole radius at half
// resolution, where taps are spread thin and thin things are missed, and a part of it at full
// resolution, for the detail so lost; the former is brought to full size across no edge of depth.
//
// Departures. Of the talk only the abstract could be read. A ray-tracing sample cites it for taking
// the largest minus the smallest value of a neighbourhood for its variance, so there, it seems,
// both resolutions share one radius and the full one replaces the half one where that varies. Here
// every pixel has both, and the darker wins: each scale sees some of the occluders of one
// hemisphere, so none is counted twice, and the result is never lighter than the darker scale, as
// Hoang and Low 2012 (MSSAO) ask. `multiply` multiplies the two instead, as programs do that stack
// two SSAO effects (pmndrs' react-postprocessing, documentation of SSAO).
//
// Limit: hbao's with the whole radius, for there the small radius finds nothing that the large one
// does not weigh at least as much. With `multiply`, visibility at R times that at detailRadius R.

#include "blur_gaussian.glsl"
#include "horizon.glsl"
#include "taps_full.glsl"

// A pixel of the half-resolution image stands for the first of the four it covers.
vec4 coarse(ivec2 pixel) {
    float depth = depthOf(2 * pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    return vec4(1.0 - horizonOcclusion(2 * pixel, pixel, depth, settings.radius, 2));
}

vec4 coarseAcross(ivec2 pixel) { return blurAlong(coarseResult, pixel, ivec2(1, 0), 2); }
vec4 coarseDown(ivec2 pixel) { return blurAlong(coarseAcrossResult, pixel, ivec2(0, 1), 2); }

vec4 detail(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    float radius = settings.detailRadius * settings.radius;
    return vec4(1.0 - horizonOcclusion(pixel, pixel, depth, radius, 1));
}

vec4 detailAcross(ivec2 pixel) { return blurAlong(detailResult, pixel, ivec2(1, 0), 1); }
vec4 detailDown(ivec2 pixel) { return blurAlong(detailAcrossResult, pixel, ivec2(0, 1), 1); }

// Joint bilateral upsampling: of the one, two or four half-resolution pixels around, it takes those
// on the pixel's own surface, as depth and normal tell. (By depth alone, creases that face the eye
// would turn to stairs.) Where none lies there, the small constant in each weight gives their mean.
float upsampledCoarse(ivec2 pixel, float depth, bool blurred) {
    vec2 slope = depthSlope(pixel, depth);
    vec3 normal = normalOf(pixel);
    ivec2 odd = pixel & 1, last = textureSize(coarseResult, 0) - 1;
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1), cell = min((pixel >> 1) + side, last);
        float facing = smoothstep(0.6, 0.9, dot(normal, normalOf(2 * cell)));
        float expected = depth + dot(slope, vec2(2 * cell - pixel));
        float weight = 1e-3 + facing * depthWeight(depth, expected, depthInside(2 * cell));
        if (any(greaterThan(side, odd)) || cell != (pixel >> 1) + side)
            weight = 0.0;
        float value =
            blurred ? texelFetch(coarseDownResult, cell, 0).r : texelFetch(coarseResult, cell, 0).r;
        sum += weight * value;
        weights += weight;
    }
    return sum / weights;
}

vec4 combine(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    bool blurred = settings.blur > 0.5;
    float large = upsampledCoarse(pixel, depth, blurred);
    float small =
        blurred ? texelFetch(detailDownResult, pixel, 0).r : texelFetch(detailResult, pixel, 0).r;
    return vec4(settings.multiply > 0.5 ? max(large, 0.0) * max(small, 0.0) : min(large, small));
}
