// HBAO+ in the form of nvpro-samples gl_ssao and of HBAO+ 3.0 (CoarseAO): HBAO's lines of taps on
// deinterleaved layers, but no horizon: every tap counts by itself, the mean of
//   sat(n . v - bias) sat(1 - t^2 / R^2),   v = direction to the tap, t = its distance,
// a sum like that of Scalable Ambient Obscurance, which cannot be raised by one tap alone. Both
// programs double the mean and gl_ssao divides it by 1 - bias: that is `intensity`.
//
// Left out: HBAO+'s second depth layer, its separate weights for the first and the further steps
// (both 1 by default) and its radii for fore- and background, all off by default.
//
// Lines end at lineLength R: HBAO+ projects all of R, gl_ssao half of it (both RadiusToScreen).
//
// Limit: taps are uniform in angle and in distance r in the image, so near ones weigh more per
// area: 1 / 2 pi L R times the integral over phi and 0 < r < L R of the term above, L = lineLength.
// For a curb seen from above, distance d and step h, with R = 1: 1 / pi L times the integral over
// 0 < phi < pi / 2 and d / cos phi < r < L of sat(h / sqrt(r^2 + h^2) - bias) sat(1 - r^2 - h^2).

#include "blur_gaussian.glsl"
#include "blur_normal.glsl"
#include "taps_layered.glsl"

vec4 shade(ivec2 pixel, int layer) {
    ivec2 place = placeOf(layer);
    ivec2 full = 4 * pixel + place;
    float depth = tapDepth(pixel, place, 4);
    Lines lines = linesFrom(full, full, depth, settings.lineLength * settings.radius, 4);
    if (isEmpty(depth) || lines.steps == 0)
        return vec4(1.0);
    vec3 position = viewPosition(uvOf(full), depth);
    vec3 normal = normalOf(full);

    float sum = 0.0;
    int directions = int(settings.directions);
    for (int i = 0; i < directions; ++i) {
        vec2 direction = lineDirection(lines, i);
        for (int step = 0; step < lines.steps; ++step) {
            vec3 surface;
            if (!tapSurface(tapPixel(lines, direction, step), 4, surface))
                continue;
            vec3 to = surface - position;
            float squared = dot(to, to);
            float rise = dot(normal, to) * inversesqrt(max(squared, 1e-30));
            sum += clamp(rise - settings.bias, 0.0, 1.0) *
                   clamp(1.0 - squared / (settings.radius * settings.radius), 0.0, 1.0);
        }
    }
    return vec4(1.0 - sum / float(directions * lines.steps));
}

vec4 blurAcross(ivec2 pixel) { return blurAlong(mergeResult, pixel, ivec2(1, 0), 1); }
vec4 blurDown(ivec2 pixel) { return blurAlong(blurAcrossResult, pixel, ivec2(0, 1), 1); }
