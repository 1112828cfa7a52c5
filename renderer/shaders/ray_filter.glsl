// What makes a picture of few rays a pixel smooth: two passes of 3 x 3 pixels, the second of pixels
// two apart (the a-trous wavelet of Dammertz et al. 2010), which leave alone what belongs to another
// surface and what differs by more than chance. Shadows are where a filter's harm is, and there the
// rays say most: after Schied et al. 2017 ("SVGF") neighbours count by how far their difference
// exceeds its standard deviation. That needs no estimate here, for n rays that are open with
// probability v are a binomial, of variance v (1 - v) / n.
//
// Departures from both: weights are parabolas cut off at 0, and all nine pixels weigh the same.

#include "depth.glsl"

// The normal's stereographic projection, from the direction away from the camera.
vec2 packedNormal(vec3 normal) { return normal.xy / max(1.0 + normal.z, 1e-4); }
vec3 unpackedNormal(vec2 place) {
    float scale = 2.0 / (1.0 + dot(place, place));
    return vec3(place * scale, scale - 1.0);
}

// How much a neighbour's surface has to do with that of a point: nothing from 30 degrees out of its
// plane and from 41 degrees between normals.
float likeness(vec3 normal, vec3 offset, vec3 other) {
    float height = dot(normal, offset);
    return max(1.0 - 4.0 * height * height / dot(offset, offset), 0.0) *
           max(1.0 - 4.0 * (1.0 - dot(normal, other)), 0.0);
}

// `chance`: of the squared difference by which a neighbour no longer counts, the part that is due
// to one ray's variance, inverted.
vec4 smoothed(sampler2D values, ivec2 pixel, int stride, float chance) {
    vec4 own = texelFetch(values, pixel, 0);
    if (isEmpty(own.a))
        return vec4(1.0, own.gba);
    vec3 normal = unpackedNormal(own.gb), position = viewPosition(uvOf(pixel), own.a);
    float sum = own.r, weights = 1.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 place = pixel + stride * (ivec2(i % 3, i / 3) - 1);
        if (i == 4 || place != insideOf(place))
            continue;
        vec4 other = texelFetch(values, place, 0);
        float middle = 0.5 * (own.r + other.r), step = own.r - other.r;
        float weight =
            likeness(normal, viewPosition(uvOf(place), other.a) - position,
                     unpackedNormal(other.gb)) *
            max(1.0 - chance * settings.rays * step * step / (middle * (1.0 - middle) + 0.02), 0.0);
        sum += weight * other.r;
        weights += weight;
    }
    return vec4(sum / weights, own.gba);
}

// Visibility, normal and depth, so that a neighbour takes one fetch.
vec4 surfaces(ivec2 pixel) {
    return vec4(texelFetch(gatherResult, pixel, 0).r,
                packedNormal(texelFetch(normalBuffer, pixel, 0).xyz), depthInside(pixel));
}
vec4 smoothNear(ivec2 pixel) { return smoothed(surfacesResult, pixel, 1, 0.08); }
// Each value is the mean of up to nine now.
vec4 smoothFar(ivec2 pixel) { return smoothed(smoothNearResult, pixel, 2, 1.0); }
