// Volumetric obscurance by one area sample (Loos and Sloan 2010): mean and variance of the depths
// that the ball covers, from a pyramid, and the open share of the ball they imply. Depth alone; no
// noise, so no blur. Visibility is doubled, for a plane fills half of the ball.
//
// The paper's full text was not at hand, so the statistical model is ours. Depths are spread evenly
// over mean -+ sqrt(3) deviations, as a slanted plane's are, and independent of the place in the
// disc. Of a ball the share (1 + x)^2 (2 - x) / 4 lies nearer than x radii behind its centre;
// its mean over that spread has a closed form.
//
// The pyramid holds mean and variance (not mean square: their difference would drown in rounding)
// of 1 / depth, which is linear across a plane on screen and finite for the sky. To first order
// depth is then (1 / here - 1 / there) here^2 behind the pixel.
//
// Limit (nothing to converge but the model): a plane is open at any slant. Where a share q of the
// area lies h nearer, mean -q h and variance q (1 - q) h^2 go into the form above; the area is a
// square of texels whose second moment equals the ball's. Beside a curb that is near the ball's own
// share (tests/renderer/techniques/limits_points_gl_test.cpp). The paper's weakness stays: beside a silhouette
// the far side widens the spread, so near things lose occlusion there and the wall behind darkens.

#include "depth.glsl"

vec4 moments(ivec2 pixel) {
    float depth = depthOf(pixel);
    return vec4(isEmpty(depth) ? 0.0 : 1.0 / depth, 0.0, 0.0, 0.0);
}

// Of parts with equal weight: the mean of means, and the mean variance plus that of the means. The
// last texel of an odd row takes the one left over as well.
vec4 momentsLevel(ivec2 pixel) {
    ivec2 size = textureSize(momentsResult, 0), last = max(size / 2, ivec2(1)) - 1;
    ivec2 begin = 2 * pixel;
    ivec2 end = min(begin + 1 + ivec2(equal(pixel, last)), size - 1);
    float count = float((end.x - begin.x + 1) * (end.y - begin.y + 1));
    vec2 mean = vec2(0.0); // of means, of variances
    for (int y = begin.y; y <= end.y; ++y)
        for (int x = begin.x; x <= end.x; ++x)
            mean += texelFetch(momentsResult, ivec2(x, y), 0).rg / count;
    for (int y = begin.y; y <= end.y; ++y)
        for (int x = begin.x; x <= end.x; ++x) {
            float apart = texelFetch(momentsResult, ivec2(x, y), 0).r - mean.x;
            mean.y += apart * apart / count;
        }
    return vec4(mean, 0.0, 0.0);
}

// The nine texels of a level around a place (in pixels), weighted by a quadratic B-spline: bilinear
// weights leave the texels' grid visible. Sums are of weight times difference to `here`, and
// times its square plus variance.
vec2 sumsOf(vec2 place, int level, float here) {
    ivec2 last = textureSize(momentsResult, level) - 1;
    vec2 texel = place / float(1 << level) - 0.5;
    vec2 nearest = floor(texel + 0.5), t = texel - nearest;
    vec2 sums = vec2(0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3, i / 3) - 1;
        vec2 aside = 0.5 + t * vec2(offset);
        vec2 weight = mix(0.5 * aside * aside, 0.75 - t * t, equal(offset, ivec2(0)));
        ivec2 at = clamp(ivec2(nearest) + offset, ivec2(0), last);
        vec2 found = texelFetch(momentsResult, at, level).rg;
        float apart = found.r - here;
        sums += weight.x * weight.y * vec2(apart, apart * apart + found.g);
    }
    return sums;
}

// The integral of the ball's share up to x (radii), from far below.
float integralOfShare(float x) {
    float y = clamp(x, -1.0, 1.0);
    return (0.75 + 2.0 * y + 1.5 * y * y - 0.25 * y * y * y * y) / 4.0 + max(x - 1.0, 0.0);
}

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    // Per axis a ball has variance R^2 / 5, and splines over texels of width L have L^2 / 3.
    // Between two levels the weight is such that variances mix to the one wanted.
    float radius = settings.radius * frame.depth.w * frame.size.y / depth; // pixels
    float width = max(sqrt(0.6) * radius, 1.0);
    int top = textureQueryLevels(momentsResult) - 1;
    int level = min(int(log2(width)), top);
    float ratio = width / float(1 << level);
    float mixing = level < top ? clamp((ratio * ratio - 1.0) / 3.0, 0.0, 1.0) : 0.0;

    vec2 place = vec2(pixel) + 0.5;
    float here = 1.0 / depth;
    vec2 sums = vec2(0.0);
    // Mesa's software driver fetches a quad of pixels from one level, whatever each asked for; so
    // pixels go through the levels together and sit out those that are not theirs.
    for (int i = 0; i <= top; ++i) {
        float weight = i == level ? 1.0 - mixing : i == level + 1 ? mixing : 0.0;
        if (weight > 0.0)
            sums += weight * sumsOf(place, i, here);
    }
    float toRadii = depth * (depth / settings.radius);
    float behind = -sums.x * toRadii;
    // Narrower spreads would divide rounding by nearly nothing.
    float spread = max(sqrt(3.0 * max(sums.y - sums.x * sums.x, 0.0)) * toRadii, 0.01);
    float open =
        (integralOfShare(behind + spread) - integralOfShare(behind - spread)) / (2.0 * spread);
    return vec4(min(2.0 * open, 1.0));
}
