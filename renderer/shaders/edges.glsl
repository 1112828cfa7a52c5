// XeGTAO's spatial denoiser: where the surface breaks off between a pixel and its four neighbours,
// packed into four bytes, and a 3 x 3 filter that weights neighbours by it.
//
// Departure: XeGTAO's edges are changes of 1.4 % of the depth (settings.edgeDepth 0.011), whatever
// the normals. Across a crease, and across reliefs that are less deep than that, occlusion changes
// within a pixel or two, and the filter's blur of it was most of what dense sampling left of the
// error. Here normals that differ are an edge too (settings.edgeAngle), and depths sooner.

#include "depth.glsl"

vec3 normalInside(ivec2 pixel) { return texelFetch(normalBuffer, insideOf(pixel), 0).xyz; }

// Left, right, below, above: 1 on one surface, 0 across an edge. A change of depth that goes on
// evenly through the pixel is a slope and no edge.
vec4 edges(ivec2 pixel) {
    float depth = depthOf(pixel);
    vec4 steps = vec4(depthOf(pixel - ivec2(1, 0)), depthOf(pixel + ivec2(1, 0)),
                      depthOf(pixel - ivec2(0, 1)), depthOf(pixel + ivec2(0, 1))) -
                 depth;
    vec2 slope = 0.5 * (steps.yw - steps.xz);
    vec4 straight = steps + vec4(slope.x, -slope.x, slope.y, -slope.y);
    vec4 level =
        clamp(1.25 - min(abs(steps), abs(straight)) / (settings.edgeDepth * depth), 0.0, 1.0);
    vec3 normal = normalInside(pixel);
    vec4 along = vec4(dot(normal, normalInside(pixel - ivec2(1, 0))),
                      dot(normal, normalInside(pixel + ivec2(1, 0))),
                      dot(normal, normalInside(pixel - ivec2(0, 1))),
                      dot(normal, normalInside(pixel + ivec2(0, 1))));
    // All at the angle, nothing at about 1.4 times that.
    float bend = 1.0 - cos(radians(settings.edgeAngle));
    return level * clamp(2.0 - (1.0 - along) / bend, 0.0, 1.0);
}

vec4 edgesOf(ivec2 pixel) { return texelFetch(edgesResult, pixel, 0); }

// What each of 3 x 3 pixels weighs.
struct Weights {
    float own;
    vec4 side;     // left, right, below, above
    vec4 diagonal; // lower left, lower right, upper left, upper right
    float sum;
};

// `last` says that this is the last of the passes, which keeps more of the pixel itself (XeGTAO's
// 1.2 against 0.24).
Weights weightsOf(ivec2 pixel, bool last) {
    ivec2 corner = ivec2(frame.size.xy) - 1;
    vec4 l = edgesOf(ivec2(max(pixel.x - 1, 0), pixel.y)),
         r = edgesOf(ivec2(min(pixel.x + 1, corner.x), pixel.y)),
         b = edgesOf(ivec2(pixel.x, max(pixel.y - 1, 0))),
         a = edgesOf(ivec2(pixel.x, min(pixel.y + 1, corner.y)));

    // An edge that one of two neighbours sees counts for both.
    vec4 side = edgesOf(pixel) * vec4(l.y, r.x, b.w, a.z);
    // A pixel with three or four edges would stay as noisy as it is: let a little through.
    float alone = clamp(1.5 - dot(side, vec4(1.0)), 0.0, 1.0) / 1.5 * 0.5;
    side = clamp(side + alone, 0.0, 1.0);

    // Diagonals are reached by two ways around the corner.
    vec4 diagonal = 0.425 * vec4(side.x * l.z + side.z * b.x, side.y * r.z + side.z * b.y,
                                 side.x * l.w + side.w * a.x, side.y * r.w + side.w * a.y);
    float own = last ? 1.2 : 0.24;
    return Weights(own, side, diagonal, own + dot(side + diagonal, vec4(1.0)));
}

// Filters what has one channel. Texels come by four around the pixel's corners, in the order of
// textureGather: upper left, upper right, lower right, lower left.
vec4 denoised(sampler2D values, ivec2 pixel, bool last) {
    if (isEmpty(depthOf(pixel)))
        return vec4(1.0);
    Weights weights = weightsOf(pixel, last);
    vec2 low = vec2(pixel) * frame.size.zw, high = vec2(pixel + 1) * frame.size.zw;
    vec4 lowerLeft = textureGather(values, low),
         lowerRight = textureGather(values, vec2(high.x, low.y)),
         upperLeft = textureGather(values, vec2(low.x, high.y)),
         upperRight = textureGather(values, high);
    vec4 side = vec4(lowerLeft.x, lowerRight.y, lowerLeft.z, upperLeft.y);
    vec4 diagonal = vec4(lowerLeft.w, lowerRight.z, upperLeft.x, upperRight.y);
    return vec4(
        (weights.own * lowerLeft.y + dot(weights.side, side) + dot(weights.diagonal, diagonal)) /
        weights.sum);
}

// Filters what has four channels, all of which but red are 0 where nothing is seen.
vec4 denoisedAll(sampler2D values, ivec2 pixel, bool last) {
    if (isEmpty(depthOf(pixel)))
        return vec4(1.0, 0.0, 0.0, 0.0);
    Weights weights = weightsOf(pixel, last);
    ivec2 low = max(pixel - 1, 0), high = min(pixel + 1, ivec2(frame.size.xy) - 1);
    vec4 sum = weights.own * texelFetch(values, pixel, 0);
    sum += weights.side.x * texelFetch(values, ivec2(low.x, pixel.y), 0) +
           weights.side.y * texelFetch(values, ivec2(high.x, pixel.y), 0) +
           weights.side.z * texelFetch(values, ivec2(pixel.x, low.y), 0) +
           weights.side.w * texelFetch(values, ivec2(pixel.x, high.y), 0);
    sum += weights.diagonal.x * texelFetch(values, low, 0) +
           weights.diagonal.y * texelFetch(values, ivec2(high.x, low.y), 0) +
           weights.diagonal.z * texelFetch(values, ivec2(low.x, high.y), 0) +
           weights.diagonal.w * texelFetch(values, high, 0);
    return sum / weights.sum;
}
