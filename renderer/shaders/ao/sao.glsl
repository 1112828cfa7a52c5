// Scalable ambient obscurance (McGuire, Mara and Luebke 2012): Alchemy's estimator from depth
// alone, at a cost that does not grow with the radius.
//
// 1. Depth and its hierarchy, each level a rotated-grid subsample of the one before.
// 2. Face normal from the depth of the 2 x 2 quad. It is wrong in pixels beside an edge, which the
//    filter hides.
// 3. Taps along a spiral (equations 6 to 8), read from level log2(r') - q' of r' pixels away
//    (equations 9 and 10). With the falloff that the authors' program recommends,
//        A = max(0, 1 - 5 sigma / (s R^6)  sum max(0, R^2 - v . v)^3
//                                              max(0, v . n - beta) / (v . v + epsilon)).
//    Sigma is the common `intensity`. It has units of length although R^6 cancels the falloff's;
//    here v is in radii, hence sigma, beta and the root of epsilon too.
// 4. Two passes of seven taps keyed on depth, by default in steps of two pixels after averaging
//    each quad, as in the authors' program. Half the pixels never reach a tap's
//    neighbours, which leaves a faint plaid; steps of one leave more noise instead.
//
// Departures: a texel of the hierarchy is placed where its depth was taken. At the tap, as in the
// authors' program, it is off by the slope, and with a radius of 190 pixels single pixels of a
// plane tilted by 60 degrees turned black. Filter weights fall to 0 over a depth difference in
// radii, not in parts of the far plane; taps that see no surface occlude nothing.
//
// Limit with beta and epsilon 0 at distance d from a step of height h, seen from above:
// A = 1 - (5 / pi) times the integral over r from d to sqrt(1 - h^2) of
// arccos(d / r) (1 - r^2 - h^2)^3 h / (r^2 + h^2), exact with level 0 (mipOffset high).

#include "depth.glsl"
#include "obscurance.glsl"
#include "spiral.glsl"

// The pixel of the level before (which has that size) from which a pixel of a level is taken. It is
// a corner of the four that this pixel covers, another one from pixel to pixel, so that no row or
// column is lost or kept as a whole.
ivec2 rotatedGrid(ivec2 pixel, ivec2 size) {
    return min(2 * pixel + ((pixel.yx & 1) ^ 1), size - 1);
}

ivec2 sizeOfLevel(int level) { return max(ivec2(frame.size.xy) >> level, 1); }

// The least of the quad's four values; what it takes for a pixel that shows no surface is
// undefined.
float leastOfQuad(float value) {
    vec2 towardsOther = 1.0 - 2.0 * vec2(ivec2(gl_FragCoord.xy) & 1);
    float row = min(value, value + towardsOther.x * dFdxFine(value));
    return min(row, row + towardsOther.y * dFdyFine(row));
}

// llvmpipe reads all four pixels of a quad from one level even where each names its own, so a quad
// goes through the levels that its own lie between, mostly one; each pixel takes from its own.
float depthAtLevel(ivec2 texel, int level) {
    int first = max(int(leastOfQuad(float(level))), 0);
    int last = min(-int(leastOfQuad(-float(level))), textureQueryLevels(hierarchyResult) - 1);
    float depth = 0.0;
    for (int l = first; l <= last; ++l)
        if (l == level)
            depth = texelFetch(hierarchyResult, texel, l).r;
    return depth;
}

vec4 hierarchy(ivec2 pixel) { return vec4(depthOf(pixel)); }

vec4 hierarchyLevel(ivec2 pixel) {
    return texelFetch(hierarchyResult, rotatedGrid(pixel, textureSize(hierarchyResult, 0)), 0);
}

// Position of the neighbour within the quad. Where the quad hangs over the border, it is that of
// the pixel beyond the border, with this pixel's depth.
vec3 quadNeighbour(ivec2 pixel, ivec2 axis) {
    ivec2 other = pixel + axis * (1 - 2 * (pixel & 1));
    return viewPosition(uvOf(other), depthOf(other));
}

vec3 faceNormal(ivec2 pixel, vec3 position) {
    vec3 across = quadNeighbour(pixel, ivec2(1, 0)) - position;
    vec3 up = quadNeighbour(pixel, ivec2(0, 1)) - position;
    vec3 normal = normalize(cross(across, up));
    return dot(normal, position) > 0.0 ? -normal : normal;
}

// From `position` to the surface that the hierarchy holds for a tap `offset` pixels away; radii.
vec3 towardsTap(ivec2 pixel, vec3 position, vec2 offset) {
    ivec2 tap = clamp(pixel + ivec2(round(offset)), ivec2(0), ivec2(frame.size.xy) - 1);
    int level = clamp(findMSB(int(length(offset))) - int(settings.mipOffset), 0,
                      textureQueryLevels(hierarchyResult) - 1);
    tap = min(tap >> level, sizeOfLevel(level) - 1);
    float depth = depthAtLevel(tap, level);
    if (isEmpty(depth))
        return vec3(0.0);
    for (; level > 0; --level)
        tap = rotatedGrid(tap, sizeOfLevel(level - 1));
    return (viewPosition(uvOf(tap), depth) - position) / settings.radius;
}

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = faceNormal(pixel, position);
    float turn = pixelTurn(pixel);
    float pixels = settings.radius / depth * frame.depth.w * frame.size.y; // of the radius

    int count = int(settings.samples);
    float sum = 0.0;
    for (int i = 0; i < count; ++i) {
        vec2 offset = spiralOffset(i, count, settings.turns, turn) * min(pixels, 1e6);
        vec3 v = towardsTap(pixel, position, offset);
        float square = dot(v, v), falloff = max(1.0 - square, 0.0);
        sum += falloff * falloff * falloff * max(dot(v, normal) - settings.bias, 0.0) /
               (square + settings.epsilon);
    }
    return visibilityOf(5.0 * sum / float(count));
}

// 1 at the same depth, 0 from `edgeDepth` radii apart.
float depthKey(float depth, float other) {
    return max(1.0 - abs(other - depth) / (settings.edgeDepth * settings.radius), 0.0);
}

// The values of a pixel (first) and of its neighbour in the quad along the axis (second), in one
// fetch. Beyond the border the neighbour is the pixel itself.
vec2 pairOf(sampler2D values, ivec2 pixel, ivec2 axis) {
    ivec2 even = pixel & ~axis;
    vec4 quad = textureGather(values, vec2(even + 1) * frame.size.zw);
    vec2 pair = axis.x > 0 ? quad.wz : quad.wx;
    return even == pixel ? pair : pair.yx;
}

vec4 blurAlong(sampler2D values, ivec2 pixel, ivec2 axis) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    float sum = 0.0, weights = 0.0;
    for (int i = -3; i <= 3; ++i) {
        ivec2 wanted = pixel + int(settings.blurStep) * i * axis, other = insideOf(wanted);
        vec2 depths = pairOf(depthBuffer, other, axis), pair = pairOf(values, other, axis);
        // A value is averaged with its neighbour in the quad unless an edge separates them; the
        // authors' program does so with derivatives.
        float value = depthKey(depths.x, depths.y) > 0.0 ? 0.5 * (pair.x + pair.y) : pair.x;
        // Spatial weight of the authors' program: a Gaussian of 1.1 taps on a pedestal.
        float weight = (0.3 + 0.357 * exp(-float(i * i) / 2.42)) * depthKey(depth, depths.x);
        weight = other == wanted ? weight : 0.0;
        sum += weight * value;
        weights += weight;
    }
    return vec4(sum / weights); // the pixel itself has weight
}

vec4 blurAcross(ivec2 pixel) { return blurAlong(gatherResult, pixel, ivec2(1, 0)); }

vec4 blurDown(ivec2 pixel) { return blurAlong(blurAcrossResult, pixel, ivec2(0, 1)); }
