// The cross-bilateral blur of HBAO and HBAO+: a Gaussian along rows, then along columns, leaving
// out pixels across an edge of depth. Its width is gl_ssao's and HBAO+'s; in place of their
// exp2(-(sharpness dz)^2), whose sharpness is per scene unit, stands blur.glsl's depth weight,
// which follows slopes and is the same at every scale.

#include "blur.glsl"

// `values` holds every stride-th pixel of the image; its red is visibility.
vec4 blurAlong(sampler2D values, ivec2 pixel, ivec2 axis, int stride) {
    float depth = depthOf(pixel * stride);
    if (isEmpty(depth))
        return vec4(1.0);
    float slope =
        smallerSlope(depthOf(pixel * stride - axis), depth, depthOf(pixel * stride + axis));
    int reach = int(settings.blurRadius);
    float sigma = 0.5 * (float(reach) + 1.0); // HBAO+; gl_ssao has half of reach
    ivec2 last = textureSize(values, 0) - 1;
    float sum = 0.0, weights = 0.0;
    for (int i = -reach; i <= reach; ++i) {
        ivec2 wanted = pixel + i * axis, other = clamp(wanted, ivec2(0), last);
        float expected = depth + slope * float(i * stride);
        float weight = exp2(-float(i * i) / (2.0 * sigma * sigma)) *
                       depthWeight(depth, expected, depthInside(other * stride));
        weight = other == wanted ? weight : 0.0;
        sum += weight * texelFetch(values, other, 0).r;
        weights += weight;
    }
    return vec4(sum / weights); // the pixel itself has weight 1
}
