// VAO++ (Bokšanský, Pospíšil, Bittner 2017): volumetric ambient occlusion with its extensions, each
// with a switch. Sections and equations below are that paper's.
//
// Limit with all switches off: the open fraction of the tangent ball. For a wall at c R, visibility
// 1 - (1 - 2 c)^2 (1 + c) / 2 up to c = 1/2, then 1. For a step of height h from x = d on, seen
// from above, with r = R / 2 and half lengths e = sqrt(r^2 - x^2 - y^2), it is 1 - 3 / (4 pi r^3)
// times the integral of clamp(h - r + e, 0, 2 e) over the disc's part x > d. With `rangeCheck` the
// integrand is 2 e u / max(u, (h - r - e) / R) where h > r + e.
//
// Departures:
// - Lines follow lines of sight through pixel centres and are clipped at the camera
//   (ball.glsl); the paper's prepared lengths hold for parallel ones. Equation 2's sum is
//   taken over the lines themselves.
// - Equation 3 as printed clamps before it divides, so its base can be negative; clamped after.
// - Equation 4 is read as the share of a hidden line's length that counts as blocked; the rest is
//   open. Were the line's whole weight meant, also in equation 2, a ball all hidden would stay
//   black at any distance, and few lines would be twice as noisy (seen in Sponza). Its d is
//   measured from where the line enters the ball, so that nothing jumps when a line disappears.
// - Equation 5 grows again beyond the radius; here it stays 0. Its x is the surface point that the
//   line's pixel shows: at the sample point itself, a plane would tint itself by c = 1/4.
// - Bright surfaces are spared after the filter, so that a lamp does not lighten the wall beside.

#include "ball.glsl"
#include "blur_normal.glsl"
#include "noise.glsl"

// Section 4.5: nine rotations dealt over 3 x 3 pixels in steps of 160 degrees, so that neighbours
// have unlike ones; the seed turns them all, and each accumulated frame by 80 degrees more. Columns
// turn a point.
mat2 tileRotation(ivec2 pixel) {
    vec2 place = vec2(pixel) - 3.0 * floor((vec2(pixel) + 0.5) / 3.0); // in the tile
    float turn = unitFloat(hash(tileSeed())) + 2.0 * float(tileFrame());
    float angle = 6.28318531 / 9.0 * (4.0 * place.x + 3.0 * place.y + turn);
    return mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
}

// The disc through the ball's centre, parallel to the screen, in pixels: where its middle is, and
// the matrix that brings points of the unit disc there.
struct Disc {
    vec2 centre;
    mat2 fromUnit;
};

float centreDepth(Ball ball) { return max(ball.depth - ball.toCentre.z, frame.depth.x); }

Disc discOf(Ball ball) {
    vec2 radii = ball.radius / centreDepth(ball) / frame.viewFromUv.xy * frame.size.xy;
    mat2 stretch = mat2(radii.x, 0.0, 0.0, radii.y);
    return Disc(uvFromView(surfaceOf(ball) + ball.toCentre) * frame.size.xy,
                stretch * tileRotation(ball.pixel));
}

// The pixel that shows a point of the disc. It is clamped as a float, because an integer cannot
// hold every float.
ivec2 discPixel(Disc disc, int i) {
    return ivec2(clamp(disc.centre + disc.fromUnit * points[i].xy, vec2(0.0), frame.size.xy - 1.0));
}

bool hasSet(int count) { return count >= 2 && count <= 32 && (count & (count - 1)) == 0; }
int firstPoint(int count) { return hasSet(count) ? count - 2 : 62; }

// Section 4.1: two lines up to the given diameter of the ball's disc, twice as many for twice the
// area. Relative to the screen, so that every resolution gets the same numbers.
int lineCount(Ball ball) {
    int most = int(settings.samples);
    if (settings.adaptive < 0.5)
        return most;
    float diameter = 2.0 * ball.radius / centreDepth(ball) * frame.depth.w;
    float doublings = 2.0 * log2(max(diameter / settings.adaptiveDiameter, 1.0));
    return min(most, 2 << int(min(doublings, 20.0)));
}

// Equation 4: the share of a line wholly behind an occluder that counts as blocked. Occluders are
// taken to be `thickness` thick: a line that has just disappeared behind one is blocked whole, and
// the farther behind it a line lies, the smaller is its share.
float blockedShare(vec2 line, float scene) {
    if (settings.rangeCheck < 0.5)
        return 1.0;
    float behind = (line.x - scene) / settings.radius;
    return settings.thickness / max(settings.thickness, behind);
}

// Equations 1 and 2.
float openFraction(Ball ball, int count) {
    Disc disc = discOf(ball);
    int first = firstPoint(count);
    float blocked = 0.0, total = 0.0;
    for (int i = first; i < first + count; ++i) {
        ivec2 tap = discPixel(disc, i);
        vec2 line = lineThrough(ball, tap);
        float scene = depthInside(tap) - ball.depth, whole = line.y - line.x;
        blocked += blockedShare(line, scene) * (whole - openLength(line, scene));
        total += whole;
    }
    return total > 0.0 ? 1.0 - blocked / total : 1.0; // a ball smaller than a pixel can be missed
}

Ball ballOf(ivec2 pixel, float depth) { return tangentBall(pixel, depth, normalOf(pixel)); }

// Section 4.2: eight lines for the pixel in the middle of each 8 x 8.
vec4 cull(ivec2 cell) {
    ivec2 pixel = min(8 * cell + 4, ivec2(frame.size.xy) - 1);
    float depth = depthOf(pixel);
    return vec4(isEmpty(depth) ? 1.0 : openFraction(ballOf(pixel, depth), 8));
}

// Whether anything may occlude the pixels of a cell. Bilinear reads at its four corners take in the
// nine cells around, 24 x 24 pixels; an occlusion of 1/256 in one of them is enough. It is done
// once per cell, because all of its pixels would find the same.
vec4 mayOcclude(ivec2 cell) {
    vec2 texel = 1.0 / vec2(textureSize(cullResult, 0));
    float least = 1.0;
    for (int corner = 0; corner < 4; ++corner)
        least =
            min(least, texture(cullResult, vec2(cell + ivec2(corner & 1, corner >> 1)) * texel).r);
    return vec4(least < 1.0 - 1.0 / 1024.0 ? 1.0 : 0.0);
}

// How many lines are left by both savings. For what the pre-pass finds open, the careful kind of
// culling still spends four, whatever the quality, and the greedy one none.
int linesFor(ivec2 pixel, Ball ball) {
    if (settings.culling < 0.5 || texelFetch(mayOccludeResult, pixel >> 3, 0).r > 0.5)
        return lineCount(ball);
    return settings.culling < 1.5 ? 0 : 4;
}

// Equation 3: the factor on occlusion.
float sensitivity(ivec2 pixel) {
    vec3 colour = texelFetch(ambientLight, pixel, 0).rgb + texelFetch(directLight, pixel, 0).rgb;
    float luminance = settings.luminanceSensitivity < 1.5
                          ? dot(colour, vec3(0.2126, 0.7152, 0.0722))
                          : max(colour.r, max(colour.g, colour.b));
    float width = settings.luminanceWidth;
    float bright = (luminance - settings.luminanceThreshold + width) / (2.0 * width);
    return pow(1.0 - clamp(bright, 0.0, 1.0), settings.luminancePower);
}

float spared(ivec2 pixel, float visibility) {
    return settings.luminanceSensitivity < 0.5 ? visibility
                                               : 1.0 - (1.0 - visibility) * sensitivity(pixel);
}

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    Ball ball = ballOf(pixel, depth);
    float visibility = openFraction(ball, linesFor(pixel, ball));
    return vec4(settings.blur < 0.5 ? spared(pixel, visibility) : visibility);
}

// Section 4.6: one of two passes along the axes of a filter that is not quite separable. Pixels
// more than the radius nearer or farther are left out.
vec4 filtered(sampler2D values, ivec2 pixel, ivec2 axis) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    bool gaussian = settings.blur > 1.5;
    int reach = gaussian ? int(settings.blurSize) / 2 : int(settings.blur);
    ivec2 last = ivec2(frame.size.xy) - 1;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = -reach; i <= reach; ++i) {
        ivec2 wanted = pixel + i * axis, other = clamp(wanted, ivec2(0), last);
        float otherDepth = depthInside(other), deviations = float(i) / settings.blurDeviation;
        float weight = gaussian ? exp(-0.5 * deviations * deviations) : 1.0;
        if (other != wanted || isEmpty(otherDepth) || abs(otherDepth - depth) > settings.radius)
            weight = 0.0;
        sum += weight * texelFetch(values, other, 0);
        weights += weight;
    }
    return sum / weights; // the pixel itself has weight 1
}

vec4 blurAcross(ivec2 pixel) { return filtered(gatherResult, pixel, ivec2(1, 0)); }

vec4 blurDown(ivec2 pixel) {
    return vec4(spared(pixel, filtered(blurAcrossResult, pixel, ivec2(0, 1)).r));
}

// Section 4.7: a mean of colours between white and the surfaces around, equation 5. Points are in
// z-order, so every second or fourth still covers the disc. Given as what is taken from white,
// which half floats hold finely.
vec4 tint(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(0.0);
    Ball ball = ballOf(pixel, depth);
    vec3 position = surfaceOf(ball), normal = normalOf(pixel), taken = vec3(0.0);
    Disc disc = discOf(ball);
    int count = linesFor(pixel, ball), first = firstPoint(count);
    int stride = int(settings.colourBleeding);
    for (int i = 0; i < count; i += stride) {
        ivec2 tap = discPixel(disc, first + i);
        vec3 towards = viewPosition(uvOf(tap), depthInside(tap)) - position;
        float range = length(towards);
        float near = 1.0 - min(range / settings.radius, 1.0);
        float share = max(dot(towards, normal), 0.0) / max(range, 1e-12) * near * near;
        taken += share * (1.0 - texelFetch(albedoBuffer, tap, 0).rgb);
    }
    return vec4(taken / float(max((count + stride - 1) / stride, 1)), 0.0);
}

vec4 tintAcross(ivec2 pixel) { return filtered(tintResult, pixel, ivec2(1, 0)); }

// The tint multiplies the product of ambient light and visibility. The composite adds that product
// by itself, so that only its change is given here. The visibility meant is that after `intensity`
// and `power`, which the last pass applies to red alone.
vec4 bleed(ivec2 pixel) {
    if (isEmpty(depthOf(pixel)))
        return vec4(1.0, 0.0, 0.0, 0.0);
    float visibility = settings.blur < 0.5 ? texelFetch(gatherResult, pixel, 0).r
                                           : texelFetch(blurDownResult, pixel, 0).r;
    vec3 taken = filtered(tintAcrossResult, pixel, ivec2(0, 1)).rgb;
    return vec4(visibility,
                -texelFetch(ambientLight, pixel, 0).rgb * finalVisibility(visibility) * taken);
}
