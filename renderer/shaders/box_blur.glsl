// The plain mean over the 4 x 4 noise tile, which takes in whatever lies there: visibility leaks
// across edges, and the sky's 1 into what stands before it.

#include "depth.glsl"

vec4 blurByBox(sampler2D values, ivec2 pixel) {
    if (isEmpty(depthOf(pixel)))
        return vec4(1.0);
    float sum = 0.0;
    for (int y = -2; y < 2; ++y)
        for (int x = -2; x < 2; ++x) {
            ivec2 other = clamp(pixel + ivec2(x, y), ivec2(0), ivec2(frame.size.xy) - 1);
            sum += texelFetch(values, other, 0).r;
        }
    return vec4(sum / 16.0);
}
