// The edge-aware blur shared by techniques: the mean over a 4 x 4 window, which holds every vector
// of the noise tile once, leaving out pixels across an edge (after Bavoil and Sainz 2009; the
// weights are of our own choosing). Surfaces are followed by their depth slope, so that a floor
// seen at a grazing angle does not count as a flight of edges.

#include "depth.glsl"

// Depth change to the next pixel: of both sides the smaller, which does not cross an edge.
float smallerSlope(float behind, float here, float ahead) {
    float a = here - behind, b = ahead - here;
    return abs(a) < abs(b) ? a : b;
}

vec2 depthSlope(ivec2 pixel, float depth) {
    return vec2(smallerSlope(depthOf(pixel - ivec2(1, 0)), depth, depthOf(pixel + ivec2(1, 0))),
                smallerSlope(depthOf(pixel - ivec2(0, 1)), depth, depthOf(pixel + ivec2(0, 1))));
}

// 1 on the plane through the pixel, 0 from 1 % of the depth away from it.
float depthWeight(float depth, vec2 slope, ivec2 offset, float other) {
    float expected = depth + dot(slope, vec2(offset));
    return max(0.0, 1.0 - abs(other - expected) / (0.01 * depth));
}

// `values` is the pass to blur; its red is visibility.
vec4 blurByDepth(sampler2D values, ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    vec2 slope = depthSlope(pixel, depth);
    float sum = 0.0, weights = 0.0;
    for (int y = -2; y < 2; ++y)
        for (int x = -2; x < 2; ++x) {
            ivec2 other = pixel + ivec2(x, y);
            if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, ivec2(frame.size.xy))))
                continue;
            float weight = depthWeight(depth, slope, ivec2(x, y), depthOf(other));
            sum += weight * texelFetch(values, other, 0).r;
            weights += weight;
        }
    return vec4(sum / weights); // the pixel itself has weight 1
}
