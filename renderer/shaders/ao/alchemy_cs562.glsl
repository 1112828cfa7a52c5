// Alchemy ambient obscurance as in the CS562 report (Kim 2022): form 1 with c = 0.1 R,
//     S = 2 pi c / n  sum max(0, N . w - delta d) H(R - |w|) / max(c^2, w . w),  A = (1 - s S)^k,
// where w leads to the tap's surface and d is that surface's depth, not the pixel's; and the taps
// of "Uniform Distribution": alpha = (i + 1/2) / n, radius alpha R / d, angle 2 pi alpha 7 n / 9 +
// phi. Despite the heading they are not uniform: radius linear in alpha crowds them at the centre,
// and 7 / 9 of a turn from one to the next gives nine directions whatever n is. s is the common
// `intensity`, k the common `power`. Filter: blur_compute.glsl.
//
// Departures: the report's R / d is a length in texture coordinates, an ellipse that depends on the
// window; here the disc is one of R metres. The report applies s and k before its filter, we after
// it (but clamp before).
//
// Limit at distance d from a step of height h, seen from above, averaged over pixels:
// A = 1 - 2 c times the integral over r from d to sqrt(1 - h^2) of
// arccos(d / r) h / max(c^2, r^2 + h^2): form 1's without the factor 2 r of an even disc.

#include "blur_normal.glsl"
#include "obscurance.glsl"
#include "spiral.glsl"

vec4 gather(ivec2 pixel) {
    float depth = depthOf(pixel);
    if (isEmpty(depth))
        return vec4(1.0);
    vec3 position = viewPosition(uvOf(pixel), depth);
    vec3 normal = normalOf(pixel);
    float turn = pixelTurn(pixel);
    int count = int(settings.samples);
    float turns = 7.0 * float(count) / 9.0;
    float sum = 0.0;
    for (int i = 0; i < count; ++i) {
        vec3 offset = towardsSurface(position, spiralOffset(i, count, turns, turn));
        float bias = settings.bias * (depth / settings.radius - offset.z);
        sum += formOneTerm(offset, normal, bias, settings.falloffStart);
    }
    return visibilityOf(6.28318531 * settings.falloffStart * sum / float(count));
}
