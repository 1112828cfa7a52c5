// The blur of blur.glsl for techniques that read normals: pixels facing another way are left out
// too.

#include "blur.glsl"

vec3 normalOf(ivec2 pixel) { return texelFetch(normalBuffer, pixel, 0).xyz; }

Window windowByNormal(ivec2 pixel, vec4 depths[4]) {
    Window window = windowOf(pixel, depths);
    vec3 normal = normalOf(pixel);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            vec3 other = normalOf(insideOf(window.corners[i] + quadPlaces[j]));
            window.weights[i][j] *= smoothstep(0.6, 0.9, dot(normal, other));
        }
    return window;
}

vec4 blurByDepthAndNormal(sampler2D values, ivec2 pixel) {
    vec4 depths[4] = depthsAround(pixel);
    if (isEmpty(depths[3].w))
        return vec4(1.0);
    Window window = windowByNormal(pixel, depths);
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        sum += dot(window.weights[i], quadOf(values, window.corners[i]));
        weights += dot(window.weights[i], vec4(1.0));
    }
    return vec4(weights > 0.0 ? sum / weights : texelFetch(values, pixel, 0).r);
}
