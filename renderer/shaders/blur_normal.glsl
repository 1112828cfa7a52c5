// The same blur for techniques that read normals: pixels facing another way are left out too.
// All four channels are blurred alike.

#include "blur.glsl"

vec3 normalOf(ivec2 pixel) { return texelFetch(normalBuffer, pixel, 0).xyz; }

vec4 blurByDepthAndNormal(sampler2D values, ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    vec2 slope = depthSlope(pixel, depth);
    vec3 normal = normalOf(pixel);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int y = -2; y < 2; ++y)
        for (int x = -2; x < 2; ++x) {
            ivec2 other = pixel + ivec2(x, y);
            if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, ivec2(frame.size.xy))))
                continue;
            float weight = depthWeight(depth, slope, ivec2(x, y), depthOf(other)) *
                           smoothstep(0.6, 0.9, dot(normal, normalOf(other)));
            sum += weight * texelFetch(values, other, 0);
            weights += weight;
        }
    return weights > 0.0 ? sum / weights : texelFetch(values, pixel, 0);
}
