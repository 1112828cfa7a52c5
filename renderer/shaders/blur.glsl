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
float depthWeight(float depth, float expected, float other) {
    return max(0.0, 1.0 - abs(other - expected) * (100.0 / depth));
}

// Four pixels are fetched at once. These are their places relative to a corner, in the order of
// textureGather.
const ivec2 quadPlaces[4] = ivec2[4](ivec2(0, 1), ivec2(1, 1), ivec2(1, 0), ivec2(0, 0));

vec2 cornerUv(ivec2 corner) { return vec2(corner + 1) * frame.size.zw; } // amid the four

vec4 quadOf(sampler2D values, ivec2 corner) { return textureGather(values, cornerUv(corner)); }

// The window around a pixel: quads from the lower left, row by row. Weights are by depth; beyond
// the border they are 0.
struct Window {
    ivec2 corners[4];
    vec4 weights[4];
};

Window windowOf(ivec2 pixel, vec4 depths[4]) {
    Window window;
    for (int i = 0; i < 4; ++i)
        window.corners[i] = pixel + 2 * ivec2(i & 1, i >> 1) - 2;
    float depth = depths[3].w;
    vec2 slope = vec2(smallerSlope(depths[2].z, depth, depths[3].z),
                      smallerSlope(depths[1].x, depth, depths[3].x));
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            ivec2 other = window.corners[i] + quadPlaces[j];
            bool inside = other == insideOf(other);
            float expected = depth + dot(slope, vec2(other - pixel));
            window.weights[i][j] = inside ? depthWeight(depth, expected, depths[i][j]) : 0.0;
        }
    return window;
}

// Depths of the window's quads; the pixel's own is the last one's w.
vec4[4] depthsAround(ivec2 pixel) {
    vec4 depths[4];
    for (int i = 0; i < 4; ++i)
        depths[i] = quadOf(depthBuffer, pixel + 2 * ivec2(i & 1, i >> 1) - 2);
    return depths;
}

// `values` is the pass to blur; its red is visibility.
vec4 blurByDepth(sampler2D values, ivec2 pixel) {
    vec4 depths[4] = depthsAround(pixel);
    if (isEmpty(depths[3].w))
        return vec4(1.0);
    Window window = windowOf(pixel, depths);
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        sum += dot(window.weights[i], quadOf(values, window.corners[i]));
        weights += dot(window.weights[i], vec4(1.0));
    }
    return vec4(sum / weights); // the pixel itself has weight 1
}
