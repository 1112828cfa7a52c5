// XeGTAO's spatial denoiser: where depth breaks off between a pixel and its four neighbours, packed
// into four bytes, and a 3 x 3 filter that weights neighbours by it.

#include "depth.glsl"

// Left, right, below, above: 1 on one surface, 0 across an edge of more than 1.4 % of the depth.
// A change that goes on evenly through the pixel is a slope and no edge.
vec4 edges(ivec2 pixel) {
    float depth = depthOf(pixel);
    vec4 steps = vec4(depthOf(pixel - ivec2(1, 0)), depthOf(pixel + ivec2(1, 0)),
                      depthOf(pixel - ivec2(0, 1)), depthOf(pixel + ivec2(0, 1))) -
                 depth;
    vec2 slope = 0.5 * (steps.yw - steps.xz);
    vec4 straight = steps + vec4(slope.x, -slope.x, slope.y, -slope.y);
    return clamp(1.25 - min(abs(steps), abs(straight)) / (0.011 * depth), 0.0, 1.0);
}

vec4 edgesOf(ivec2 pixel) { return texelFetch(edgesResult, pixel, 0); }

// `last` is the last of the passes: it keeps more of the pixel itself (XeGTAO's 1.2 against 0.24).
vec4 denoised(sampler2D values, ivec2 pixel, bool last) {
    if (isEmpty(depthOf(pixel)))
        return vec4(1.0, 0.0, 0.0, 0.0);
    ivec2 corner = ivec2(frame.size.xy) - 1;
    ivec2 left = max(pixel - ivec2(1, 0), 0), right = min(pixel + ivec2(1, 0), corner);
    ivec2 below = max(pixel - ivec2(0, 1), 0), above = min(pixel + ivec2(0, 1), corner);
    vec4 l = edgesOf(left), r = edgesOf(right), b = edgesOf(below), a = edgesOf(above);

    // An edge that one of two neighbours sees counts for both.
    vec4 side = edgesOf(pixel) * vec4(l.y, r.x, b.w, a.z);
    // A pixel with three or four edges would stay as noisy as it is: let a little through.
    float alone = clamp(1.5 - dot(side, vec4(1.0)), 0.0, 1.0) / 1.5 * 0.5;
    side = clamp(side + alone, 0.0, 1.0);

    // Diagonals are reached by two ways around the corner.
    vec4 diagonal = 0.425 * vec4(side.x * l.z + side.z * b.x, side.y * r.z + side.z * b.y,
                                 side.x * l.w + side.w * a.x, side.y * r.w + side.w * a.y);
    float own = last ? 1.2 : 0.24;
    vec4 sum = own * texelFetch(values, pixel, 0);
    sum += side.x * texelFetch(values, left, 0) + side.y * texelFetch(values, right, 0) +
           side.z * texelFetch(values, below, 0) + side.w * texelFetch(values, above, 0);
    sum += diagonal.x * texelFetch(values, ivec2(left.x, below.y), 0) +
           diagonal.y * texelFetch(values, ivec2(right.x, below.y), 0) +
           diagonal.z * texelFetch(values, ivec2(left.x, above.y), 0) +
           diagonal.w * texelFetch(values, ivec2(right.x, above.y), 0);
    return sum / (own + dot(side + diagonal, vec4(1.0)));
}
